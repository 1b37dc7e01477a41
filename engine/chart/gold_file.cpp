#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/chart/chart_row.h"
#include "engine/chart/gold_standard.h"
#include "engine/chart/table_file.h"
#include "engine/error.h"

namespace patina {
namespace {

constexpr const char* kFile = "gold.csv";

/// What decides the draws, beside the target.
std::string plan_text(const GoldPlan& plan) {
  std::string text = "seed " + std::to_string(plan.trial.seed) + "; " + std::to_string(plan.trial.draws) +
                     " draws a chain at most; " + exact_text(plan.trial.seconds) + " s each";
  for (const ChartSetting& setting : plan.settings) {
    text += "; " + setting.name;
    for (const auto& [column, value] : setting_cells(setting))
      if (column != "setting") text += " " + column + " " + value;
  }
  return text;
}

bool fits(const TableFile& table, const std::vector<std::string>& names,
          const std::vector<double>& fingerprint, const GoldPlan& plan) {
  return table.columns == names && table.value("plan") == plan_text(plan) &&
         same_target(parse_numbers(table.value("fingerprint")), fingerprint);
}

}  // namespace

void write_gold(const std::filesystem::path& folder, const QuantityDraws& draws,
                const std::vector<std::string>& names, const std::vector<double>& fingerprint,
                const GoldPlan& plan) {
  std::vector<const Eigen::MatrixXd*> quantities;
  for (const auto* part : {&draws.continuous, &draws.discrete})
    for (const Eigen::MatrixXd& matrix : *part) quantities.push_back(&matrix);
  TableFile table;
  table.header = {{"fingerprint", numbers_text(fingerprint)},
                  {"plan", plan_text(plan)},
                  {"continuous", std::to_string(draws.continuous.size())},
                  {"chains", std::to_string(quantities.front()->cols())}};
  table.columns = names;
  for (Eigen::Index k = 0; k < quantities.front()->cols(); ++k)
    for (Eigen::Index i = 0; i < quantities.front()->rows(); ++i) {
      std::vector<std::string>& row = table.rows.emplace_back();
      for (const Eigen::MatrixXd* matrix : quantities) row.push_back(exact_text((*matrix)(i, k)));
    }
  write_table(folder / kFile, table);
}

std::optional<QuantityDraws> read_gold(const std::filesystem::path& folder,
                                       const std::vector<std::string>& names,
                                       const std::vector<double>& fingerprint, const GoldPlan& plan) {
  const std::optional<TableFile> table = read_table(folder / kFile);
  if (!table || !fits(*table, names, fingerprint, plan)) return std::nullopt;
  const auto continuous = static_cast<std::size_t>(parse_number(table->value("continuous")));
  const auto chains = static_cast<Eigen::Index>(parse_number(table->value("chains")));
  if (chains < 1 || table->rows.empty() || table->rows.size() % static_cast<std::size_t>(chains) != 0)
    throw UserError("The gold standard in " + folder.string() + " is damaged: remove it to draw it anew.");
  const Eigen::Index draws = std::ssize(table->rows) / chains;
  QuantityDraws result;
  for (std::size_t q = 0; q < names.size(); ++q) {
    Eigen::MatrixXd& matrix =
        (q < continuous ? result.continuous : result.discrete).emplace_back(draws, chains);
    for (Eigen::Index row = 0; row < draws * chains; ++row)
      matrix(row % draws, row / draws) = parse_number(table->rows[static_cast<std::size_t>(row)][q]);
  }
  return result;
}

}  // namespace patina
