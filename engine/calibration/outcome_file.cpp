#include "engine/calibration/outcome_file.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/chart/table_file.h"
#include "engine/error.h"

namespace patina {
namespace {

constexpr const char* kStudy = "study";
constexpr std::size_t kOfPhoto = 7, kOfQuantity = 3;  // columns

std::vector<std::string> columns(const std::vector<std::string>& quantities) {
  std::vector<std::string> names{"photo",    "seconds",  "worst_rhat", "least_ess",
                                 "distance", "widening", "simulated"};
  for (const std::string& quantity : quantities)
    for (const char* what : {"_place", "_sd_over_prior_sd", "_rhat"}) names.push_back(quantity + what);
  return names;
}

std::vector<std::string> row_of(const PhotoOutcome& outcome) {
  std::vector<std::string> row{std::to_string(outcome.photo)};
  for (const double number : {outcome.seconds, outcome.worst_rhat, outcome.least_ess, outcome.distance,
                              outcome.widening, outcome.simulated})
    row.push_back(exact_text(number));
  for (const TruthAndPosterior& quantity : outcome.quantities)
    for (const double number : {quantity.place, quantity.sd_over_prior_sd, quantity.rhat})
      row.push_back(exact_text(number));
  return row;
}

PhotoOutcome outcome_of(const std::vector<std::string>& row) {
  std::vector<double> numbers;
  for (const std::string& cell : row) numbers.push_back(parse_number(cell));
  PhotoOutcome outcome{static_cast<int>(numbers[0]),
                       numbers[1],
                       numbers[2],
                       numbers[3],
                       numbers[4],
                       numbers[5],
                       numbers[6],
                       {}};
  for (std::size_t i = kOfPhoto; i < numbers.size(); i += kOfQuantity)
    outcome.quantities.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return outcome;
}

/// The inverse of columns().
std::vector<std::string> quantities_of(const std::vector<std::string>& columns) {
  constexpr std::string_view kFirst = "_place";
  std::vector<std::string> quantities;
  for (std::size_t i = kOfPhoto; i < columns.size(); i += kOfQuantity)
    if (columns[i].ends_with(kFirst))
      quantities.push_back(columns[i].substr(0, columns[i].size() - kFirst.size()));
  return quantities;
}

}  // namespace

OutcomeFile OutcomeFile::read(const std::filesystem::path& file) {
  const auto table = read_table(file);
  if (!table) throw UserError("There is no " + file.string() + ": make it with 'patina-cli calibrate'.");
  return {file, table->value(kStudy), quantities_of(table->columns)};
}

OutcomeFile::OutcomeFile(std::filesystem::path file, std::string study, std::vector<std::string> quantities)
    : file_(std::move(file)), study_(std::move(study)), quantities_(std::move(quantities)) {
  const auto table = read_table(file_);
  if (!table) return;
  if (table->value(kStudy) != study_ || table->columns != columns(quantities_))
    throw UserError(file_.string() + " holds another study (" + table->value(kStudy) +
                    "): choose another folder, or ask for that one.");
  for (const auto& row : table->rows) outcomes_.push_back(outcome_of(row));
}

bool OutcomeFile::has(int photo) const {
  return std::ranges::find(outcomes_, photo, &PhotoOutcome::photo) != outcomes_.end();
}

void OutcomeFile::add(PhotoOutcome outcome) {
  const auto place = std::ranges::upper_bound(outcomes_, outcome.photo, {}, &PhotoOutcome::photo);
  outcomes_.insert(place, std::move(outcome));
  TableFile table{{{kStudy, study_}}, columns(quantities_), {}};
  for (const PhotoOutcome& each : outcomes_) table.rows.push_back(row_of(each));
  write_table(file_, table);
}

}  // namespace patina
