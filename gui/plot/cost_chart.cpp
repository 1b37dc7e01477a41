#include "gui/plot/cost_chart.h"

#include <algorithm>
#include <cmath>

#include "engine/chart/chart_points.h"
#include "engine/io/file.h"
#include "gui/run_outlook.h"
#include "gui/words.h"

namespace patina {
namespace {

/// Repeats of one setting differ in cost by less.
constexpr double kClearlyCheaper = 0.87;

std::vector<std::size_t> front_of(const std::vector<DrawingCost>& costs) {
  std::vector<CostError> points;
  for (const DrawingCost& cost : costs) points.push_back({cost.seconds, cost.error});
  return pareto_front(points);
}

bool may_emulate(const RunSettings& run) {
  return run.errors != "calibrated" && (run.kernel == kAuto || run.kernel == kEmulated);
}

bool same_kernel(const ChartSetting& setting, const RunSettings& run) {
  if (run.kernel != kAuto) return setting.kernel == run.kernel;
  return setting.name == kDefaultSetting || setting.kernel == (may_emulate(run) ? kEmulated : "hmc");
}

/// What a run takes that is told nothing of errors, the default has; but it averages nothing that it cannot
/// emulate.
bool same_errors(const ChartSetting& setting, const RunSettings& run) {
  if (run.errors != kAuto) return setting.errors == run.errors;
  return may_emulate(run) ? setting.name == kDefaultSetting : setting.errors == "paper";
}

}  // namespace

std::optional<CostChart> read_cost_chart(const std::filesystem::path& file) {
  const auto table = read_table(file);
  if (!table) return std::nullopt;
  const std::vector<ChartRow> rows = chart_rows(*table);
  CostChart chart;
  chart.target = table->value("target");
  for (const ChartPoint& point : chart_points(rows)) {
    const auto row = std::ranges::find(rows, point.name, [](const ChartRow& r) { return r.setting.name; });
    const DrawingCost cost{row->setting, point.seconds_per_draw.median, point.mean.value.median,
                           point.mean.beyond_chance};
    if (std::isfinite(cost.seconds) && std::isfinite(cost.error) && cost.seconds > 0 && cost.error > 0)
      chart.costs.push_back(cost);
  }
  chart.front = front_of(chart.costs);
  return chart;
}

std::filesystem::path bundled_chart_file(const std::string& material) {
  return data_directory() / "charts" / material / "chart.csv";
}

std::optional<std::size_t> find_cost(const CostChart& chart, const RunSettings& settings) {
  const auto alike = [&](const DrawingCost& cost) {
    const ChartSetting& s = cost.setting;
    const bool own_posterior = s.resolution == 0 && s.summary.empty() && s.proposals == 0;
    return own_posterior && same_errors(s, settings) && s.precision == settings.precision &&
           same_kernel(s, settings) && s.metric == settings.metric && s.discrete == settings.discrete &&
           s.chains == settings.chains && s.alpha == settings.alpha && s.refresh == settings.refresh &&
           s.path_length == settings.path_length;
  };
  const auto found = std::ranges::find_if(chart.costs, alike);
  if (found == chart.costs.end()) return std::nullopt;
  return static_cast<std::size_t>(found - chart.costs.begin());
}

std::string spent_text(const StopEvidence& evidence, double seconds, double rate) {
  constexpr double kLeastEss = 10;
  if (evidence.least_ess_of.empty() || !(evidence.least_ess >= kLeastEss)) return "";
  const double error = 1 / std::sqrt(evidence.least_ess);
  const double more = 3 * static_cast<double>(evidence.draws) / (rate > 0 ? rate : evidence.draws / seconds);
  return "So far: " + number_text(seconds / evidence.least_ess, 2) + " s for each of " +
         count_text(std::llround(evidence.least_ess)) + " independent draws. Averages are good to about " +
         number_text(100 * error, 2) +
         " % of a parameter's spread; half of that takes four times the draws, " + duration_text(more) +
         " more.";
}

std::string alternatives_text(const CostChart& chart, std::size_t own) {
  const DrawingCost& mine = chart.costs[own];
  std::string cheaper, off, other;
  for (const DrawingCost& cost : chart.costs) {
    if (!(cost.seconds < kClearlyCheaper * mine.seconds)) continue;
    const bool asks_another_question = cost.setting.errors != mine.setting.errors;
    const bool differs = asks_another_question || cost.beyond_chance;
    std::string& list = asks_another_question ? other : cost.beyond_chance ? off : cheaper;
    list += (list.empty() ? "" : ", ") + cost.setting.name + " (" +
            number_text(cost.seconds / mine.seconds, 2) + " times the time a draw" +
            (differs ? ", averages " + number_text(cost.error, 2) + " spreads away" : "") + ")";
  }
  std::string text = cheaper.empty() ? "No other way that was tried is clearly cheaper and as right."
                                     : "Cheaper and as right: " + cheaper + ".";
  if (!off.empty()) text += " Cheaper but wrong: " + off + ".";
  if (!other.empty()) text += " Cheaper, by other assumptions about errors: " + other + ".";
  return text;
}

}  // namespace patina
