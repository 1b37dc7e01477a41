#include "engine/calibration/report.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace patina {
namespace {

constexpr double kNotIdentified = 0.9;  // posterior sd over prior sd

std::string text(const char* format, auto... values) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string line(const QuantityCoverage& quantity) {
  std::string line = "| " + quantity.name + " | ";
  line += quantity.sd_over_prior_sd == quantity.sd_over_prior_sd ? text("%.2f", quantity.sd_over_prior_sd)
                                                                 : std::string("–");
  if (!quantity.identified) line += " (not identified)";
  for (const double share : quantity.coverage.share) line += text(" | %.0f", 100 * share);
  return line + text(" | %.3g |\n", quantity.coverage.uniformity);
}

}  // namespace

CalibrationReport report_of(const std::vector<std::string>& quantities,
                            const std::vector<PhotoOutcome>& outcomes) {
  CalibrationReport report;
  report.photos = static_cast<int>(outcomes.size());
  for (const PhotoOutcome& outcome : outcomes) {
    report.converged += outcome.worst_rhat <= kConverged;
    report.worst_rhat = std::max(report.worst_rhat, outcome.worst_rhat);
    report.seconds += outcome.seconds / report.photos;
  }
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    std::vector<double> places;
    double sd = 0;
    for (const PhotoOutcome& outcome : outcomes) {
      places.push_back(outcome.quantities[q].place);
      sd += outcome.quantities[q].sd_over_prior_sd / report.photos;
    }
    report.quantities.push_back({quantities[q], sd, !(sd >= kNotIdentified), coverage(places)});
  }
  return report;
}

std::string to_markdown(const CalibrationReport& report, const std::string& title) {
  std::string table = "### " + title + "\n\n";
  table += text("%d photos, of which %d converged", report.photos, report.converged) +
           text(" (R-hat at most %.2f; the worst is %.3f)", kConverged, report.worst_rhat) +
           text("; %.1f s a photo.\n\n", report.seconds);
  table += "| | sd / prior sd | 50 % | 80 % | 90 % | 95 % | p (uniform) |\n|---|---|---|---|---|---|---|\n";
  for (const QuantityCoverage& quantity : report.quantities) table += line(quantity);
  if (report.quantities.empty() || report.photos == 0) return table;
  table += "| *standard error* | ";
  const Coverage& any = report.quantities.front().coverage;
  for (std::size_t i = 0; i < kIntervals.size(); ++i) table += text(" | ±%.0f", 100 * any.error(i));
  return table + " | |\n";
}

}  // namespace patina
