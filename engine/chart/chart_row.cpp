#include "engine/chart/chart_row.h"

#include <charconv>
#include <functional>
#include <type_traits>

#include "engine/error.h"

namespace patina {
namespace {

std::string text_of(const std::string& value) { return value; }
std::string text_of(double value) { return exact_text(value); }
template <typename Integer>
requires std::is_integral_v<Integer> std::string text_of(Integer value) { return std::to_string(value); }

void read_into(const std::string& text, std::string& value) { value = text; }
void read_into(const std::string& text, double& value) { value = parse_number(text); }
template <typename Integer>
requires std::is_integral_v<Integer>
void read_into(const std::string& text, Integer& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw UserError("'" + text + "' stands in chart.csv where a whole number should: choose another --out.");
}

/// A column of a table of T.
template <typename T>
struct Column {
  std::string name;
  std::function<std::string(const T&)> text;
  std::function<void(T&, const std::string&)> read;
};

template <typename T, typename Field>
Column<T> column(const std::string& name, Field T::*field) {
  return {name, [=](const T& row) { return text_of(row.*field); },
          [=](T& row, const std::string& text) { read_into(text, row.*field); }};
}

/// Of a field of a field of ...
template <typename T, typename Part, typename... Fields>
Column<T> column(const std::string& name, Part T::*part, Fields... fields) {
  const Column<Part> inner = column(name, fields...);
  return {name, [=](const T& row) { return inner.text(row.*part); },
          [=](T& row, const std::string& text) { inner.read(row.*part, text); }};
}

const std::vector<Column<ChartSetting>>& setting_columns() {
  static const std::vector<Column<ChartSetting>> columns{
      column("setting", &ChartSetting::name),          column("kernel", &ChartSetting::kernel),
      column("metric", &ChartSetting::metric),         column("discrete", &ChartSetting::discrete),
      column("start", &ChartSetting::start),           column("errors", &ChartSetting::errors),
      column("summary", &ChartSetting::summary),       column("precision", &ChartSetting::precision),
      column("resolution", &ChartSetting::resolution), column("chains", &ChartSetting::chains),
      column("warmup", &ChartSetting::warmup),         column("alpha", &ChartSetting::alpha),
      column("refresh", &ChartSetting::refresh),       column("path_length", &ChartSetting::path_length),
      column("proposals", &ChartSetting::proposals),
  };
  return columns;
}

void add_error(std::vector<Column<ChartRow>>& columns, const std::string& name, WorstError Accuracy::*error) {
  const auto add = [&](const char* suffix, auto WorstError::*field) {
    columns.push_back(column(name + suffix, &ChartRow::accuracy, error, field));
  };
  add("_error", &WorstError::value);
  add("_bar", &WorstError::bar);
  add("_of", &WorstError::of);
  add("_largest_bars", &WorstError::largest_bars);
}

std::vector<Column<ChartRow>> all_columns() {
  std::vector<Column<ChartRow>> columns;
  for (const Column<ChartSetting>& of_setting : setting_columns())
    columns.push_back({of_setting.name, [=](const ChartRow& row) { return of_setting.text(row.setting); },
                       [=](ChartRow& row, const std::string& text) { of_setting.read(row.setting, text); }});
  for (const Column<ChartRow>& more : {
           column("repeat", &ChartRow::repeat),
           column("seed", &ChartRow::seed),
           column("draws", &ChartRow::draws),
           column("seconds", &ChartRow::seconds),
           column("search_seconds", &ChartRow::search_seconds),
           column("warmup_seconds", &ChartRow::warmup_seconds),
           column("processor_seconds", &ChartRow::processor_seconds),
           column("evaluations", &ChartRow::evaluations),
           column("search_evaluations", &ChartRow::search_evaluations),
           column("warmup_evaluations", &ChartRow::warmup_evaluations),
           column("value_evaluations", &ChartRow::value_evaluations),
           column("least_ess", &ChartRow::accuracy, &Accuracy::least_ess),
           column("least_ess_of", &ChartRow::accuracy, &Accuracy::least_ess_of),
           column("largest_rhat", &ChartRow::accuracy, &Accuracy::largest_rhat),
       })
    columns.push_back(more);
  add_error(columns, "mean", &Accuracy::mean);
  add_error(columns, "sd", &Accuracy::sd);
  add_error(columns, "wasserstein", &Accuracy::wasserstein);
  add_error(columns, "levels", &Accuracy::levels);
  const auto ignore = [](ChartRow&, const std::string&) {};
  columns.push_back({"seconds_per_effective_draw",
                     [](const ChartRow& row) { return text_of(row.seconds_per_draw()); }, ignore});
  columns.push_back({"evaluations_per_effective_draw",
                     [](const ChartRow& row) { return text_of(row.evaluations_per_draw()); }, ignore});
  return columns;
}

const std::vector<Column<ChartRow>>& row_columns() {
  static const std::vector<Column<ChartRow>> columns = all_columns();
  return columns;
}

}  // namespace

ChartRow make_row(const ChartSetting& setting, int repeat, const TrialPlan& plan, const Trial& trial,
                  const Accuracy& accuracy) {
  ChartRow row;
  row.setting = setting;
  row.repeat = repeat;
  row.seed = plan.seed;
  for (const TrialChain& chain : trial.chains) row.draws += std::ssize(chain.seconds);
  row.seconds = trial.seconds;
  row.search_seconds = trial.search_seconds;
  row.warmup_seconds = trial.warmup_seconds;
  row.processor_seconds = trial.processor_seconds;
  row.evaluations = trial.evaluations;
  row.search_evaluations = trial.search_evaluations;
  row.warmup_evaluations = trial.warmup_evaluations;
  row.value_evaluations = trial.value_evaluations;
  row.accuracy = accuracy;
  return row;
}

std::vector<std::pair<std::string, std::string>> setting_cells(const ChartSetting& setting) {
  std::vector<std::pair<std::string, std::string>> cells;
  for (const Column<ChartSetting>& column : setting_columns())
    cells.emplace_back(column.name, column.text(setting));
  return cells;
}

std::vector<std::string> chart_columns() {
  std::vector<std::string> names;
  for (const Column<ChartRow>& column : row_columns()) names.push_back(column.name);
  return names;
}

std::vector<std::string> chart_cells(const ChartRow& row) {
  std::vector<std::string> cells;
  for (const Column<ChartRow>& column : row_columns()) cells.push_back(column.text(row));
  return cells;
}

std::vector<ChartRow> chart_rows(const TableFile& table) {
  if (table.columns != chart_columns())
    throw UserError("A chart.csv with other columns cannot be read: choose another --out.");
  std::vector<ChartRow> rows;
  for (const std::vector<std::string>& cells : table.rows) {
    ChartRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) row_columns()[i].read(row, cells[i]);
  }
  return rows;
}

}  // namespace patina
