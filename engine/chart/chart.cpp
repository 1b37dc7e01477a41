#include "engine/chart/chart.h"

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "engine/chart/chart_points.h"
#include "engine/chart/draw_chart.h"
#include "engine/chart/machine.h"
#include "engine/chart/waiting.h"
#include "engine/error.h"
#include "engine/format.h"
#include "engine/io/file.h"
#include "engine/run/run_checks.h"

namespace patina {
namespace {

std::string gold_text(const GoldStandard& gold, const GoldPlan& plan) {
  std::string kernels;
  for (const ChartSetting& setting : plan.settings) {
    const std::string& name = setting.name;
    kernels += (kernels.empty() ? "" : " and ") + name.substr(name.starts_with("gold: ") ? 6 : 0);
  }
  const GoldQuantity &converged = gold.least_converged(), &effective = gold.least_effective();
  return (gold.is_gold() ? "Gold standard by " : "NOT a gold standard (R-hat above 1.01): ") + kernels +
         ", " + std::to_string(converged.draws.size()) + " draws: R-hat over both at most " +
         format("%.4f", converged.rhat) + " (" + converged.name + "), effective draws at least " +
         format("%.0f", effective.bulk_ess) + " (" + effective.name + ").";
}

std::string limits_text(const TrialPlan& trial) {
  return (trial.seconds > 0 ? format("%g s a trial, ", trial.seconds) : "") + "at most " +
         std::to_string(trial.draws) + " draws a chain";
}

/// "warm-up 500, " if it is all settings'; else nothing.
std::string warmup_text(const std::vector<ChartSetting>& settings) {
  const bool same = std::ranges::all_of(
      settings, [&](const ChartSetting& setting) { return setting.warmup == settings.front().warmup; });
  return settings.empty() || !same ? "" : "warm-up " + std::to_string(settings.front().warmup) + ", ";
}

/// A chart being made in a directory.
class Charter {
 public:
  Charter(const ChartProblem& problem, const ChartPlan& plan, const std::filesystem::path& directory,
          const std::function<void(const std::string&)>& progress)
      : problem_(problem),
        plan_(plan),
        directory_(directory),
        progress_(progress),
        fingerprint_(fingerprint(*target_of(problem))),
        header_(make_header()),
        there_(find_chart()),
        gold_(find_gold(), problem.names()) {
    tell(gold_text(gold_, plan_.gold));
    add_gold_to_header();
    take_up();
  }

  std::vector<ChartRow> run() {
    for (int repeat = 1; repeat <= plan_.repeats; ++repeat)
      for (const ChartSetting& setting : plan_.settings)
        if (!is_done(setting, repeat)) try_out(setting, repeat);
    draw();
    return rows_;
  }

 private:
  void tell(const std::string& line) const {
    if (progress_) progress_(line);
  }

  QuantityDraws find_gold() const {
    const std::filesystem::path folder = directory_ / "gold";
    make_folder(folder);
    const std::vector<std::string> names = problem_.names();
    if (auto known = read_gold(folder, names, fingerprint_, plan_.gold)) return *known;
    if (there_)
      throw UserError("The gold standard of the chart in " + directory_.string() +
                      " is gone or was drawn in another way (--gold-minutes): choose another --out.");
    tell("drawing the gold standard");
    write_gold(folder, draw_gold(problem_, plan_.gold), names, fingerprint_, plan_.gold);
    return read_gold(folder, names, fingerprint_, plan_.gold).value();
  }

  std::vector<std::pair<std::string, std::string>> make_header() const {
    return {{"program", plan_.program},
            {"processor", processor_name()},
            {"cores", std::to_string(std::thread::hardware_concurrency())},
            {"threads", std::to_string(plan_.trial.threads) + " in the search; then one a chain"},
            {"target", problem_.description()},
            {"fingerprint", numbers_text(fingerprint_)},
            {"seed", std::to_string(plan_.trial.seed)},
            {"limits", limits_text(plan_.trial)}};
  }

  void add_gold_to_header() {
    const std::filesystem::path file = directory_ / "gold" / "gold.csv";
    header_.emplace_back("gold", gold_text(gold_, plan_.gold));
    header_.emplace_back("gold_sha256", sha256_hex(read_file(file, std::size_t{256} << 20)));
  }

  /// The chart that is there. It is refused before anything of it, its gold standard, say, is written over.
  std::optional<TableFile> find_chart() const {
    auto table = read_table(directory_ / "chart.csv");
    if (table) check_same_chart(*table);
    return table;
  }

  /// Rows and curves that are there, but for those of settings that mean something else now.
  void take_up() {
    if (!there_) return;
    check_same_chart(*there_);
    rows_ = chart_rows(*there_);
    std::erase_if(rows_, [&](const ChartRow& row) {
      return std::ranges::any_of(plan_.settings, [&](const ChartSetting& setting) {
        return setting.name == row.setting.name && setting != row.setting;
      });
    });
    if (const auto curves = read_table(directory_ / "waiting.csv")) curves_ = waiting_curves(*curves);
    std::erase_if(curves_, [&](const WaitingCurve& curve) {
      return std::ranges::none_of(rows_, [&](const ChartRow& row) {
        return row.setting.name == curve.setting && row.repeat == curve.repeat;
      });
    });
  }

  void check_same_chart(const TableFile& table) const {
    for (const auto& [key, value] : header_) {
      const std::string there = table.value(key);
      const bool same =
          key == "fingerprint" ? same_target(parse_numbers(there), fingerprint_) : there == value;
      if (!same)
        throw UserError("The chart in " + directory_.string() + " was made with another " + key + " (" +
                        there + "): choose another --out.");
    }
  }

  bool is_done(const ChartSetting& setting, int repeat) const {
    return std::ranges::any_of(
        rows_, [&](const ChartRow& row) { return row.setting == setting && row.repeat == repeat; });
  }

  void try_out(const ChartSetting& setting, int repeat) {
    TrialPlan trial = plan_.trial;
    trial.seed += static_cast<std::uint64_t>(repeat) - 1;
    try {
      const Trial result = run_trial(problem_, setting, trial);
      rows_.push_back(make_row(setting, repeat, trial, result, compare(result.draws(), gold_, trial.seed)));
      curves_.push_back({setting.name, repeat, waiting_curve(result, gold_)});
    } catch (const UserError& error) {
      return tell(setting.name + " is left out: " + error.what());
    }
    save();
    const ChartRow& row = rows_.back();
    tell("repeat " + std::to_string(repeat) + " of " + std::to_string(plan_.repeats) + ", " + setting.name +
         ": " + std::to_string(row.draws) + " draws, " + format("%.3g", row.seconds_per_draw()) + " s and " +
         format("%.3g", row.evaluations_per_draw()) + " evaluations per effective draw, error of a mean " +
         format("%.2g", row.accuracy.mean.value) + " sd");
  }

  /// The curve first: a row says that the repeat is done.
  void save() const {
    TableFile waiting = waiting_table(curves_), chart;
    waiting.header = chart.header = header_;
    write_table(directory_ / "waiting.csv", waiting);
    chart.columns = chart_columns();
    for (const ChartRow& row : rows_) chart.rows.push_back(chart_cells(row));
    write_table(directory_ / "chart.csv", chart);
    draw();
  }

  void draw() const {
    double floor = 0;
    for (const GoldQuantity& quantity : gold_.continuous())
      floor = std::max(floor, quantity.mcse_mean / quantity.sd);
    const ChartTitle title{
        problem_.description(), gold_text(gold_, plan_.gold),
        warmup_text(plan_.settings) + limits_text(plan_.trial) + "; " + std::to_string(plan_.repeats) +
            " repeats; seed " + std::to_string(plan_.trial.seed) + "; " + processor_name() + ", " +
            std::to_string(std::thread::hardware_concurrency()) + " cores; " + plan_.program};
    write_scene(directory_, "chart", draw_chart(chart_points(rows_), title));
    write_scene(directory_, "waiting", draw_waiting(curves_, floor, title));
  }

  const ChartProblem& problem_;
  const ChartPlan& plan_;
  std::filesystem::path directory_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<double> fingerprint_;
  std::vector<std::pair<std::string, std::string>> header_;  ///< what makes it this chart
  std::optional<TableFile> there_;
  GoldStandard gold_;
  std::vector<ChartRow> rows_;
  std::vector<WaitingCurve> curves_;
};

}  // namespace

ChartPlan make_plan(std::vector<ChartSetting> settings, std::uint64_t seed, double seconds, int draws,
                    double gold_seconds, int gold_draws) {
  constexpr std::uint64_t kGoldSeeds = 1'000'003;  // away from those of repeats
  const auto threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  ChartPlan plan;
  plan.trial = {seed, draws, seconds, threads};
  plan.gold = {gold_settings(settings.front()), {seed + kGoldSeeds, gold_draws, gold_seconds, threads}};
  plan.settings = std::move(settings);
  return plan;
}

std::vector<ChartRow> make_chart(const ChartProblem& problem, const ChartPlan& plan,
                                 const std::filesystem::path& directory,
                                 const std::function<void(const std::string&)>& progress) {
  return Charter(problem, plan, directory, progress).run();
}

}  // namespace patina
