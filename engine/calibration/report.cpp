#include "engine/calibration/report.h"

#include <algorithm>
#include <limits>

#include "engine/format.h"

namespace patina {
namespace {

constexpr double kNotIdentified = 0.9;  // posterior sd over prior sd

bool falls_short(const QuantityCoverage& quantity, std::size_t interval) {
  return quantity.identified && kIntervals[interval] == 0.9 && !is_covered(quantity.coverage.share[interval]);
}

std::string line(const QuantityCoverage& quantity) {
  std::string line = "| " + quantity.name + " | ";
  line += (quantity.is_parameter() ? format("%.2f", quantity.sd_over_prior_sd) : "") + " | " +
          (quantity.identified ? "yes" : "no");
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    line += format(falls_short(quantity, i) ? " | **%.0f ± %.0f**" : " | %.0f ± %.0f",
                   100 * quantity.coverage.share[i], 100 * quantity.coverage.error(i));
  return line + format(" | %.1f (%.2g) |\n", quantity.coverage.chi_square, quantity.coverage.uniformity);
}

std::string cost(const CalibrationReport& report) {
  std::string cost = format("%d photos, of which the chains of %d agree", report.photos, report.converged) +
                     format(" (R-hat at most %.2f; the worst is %.3f)", kConverged, report.worst_rhat) +
                     format("; %.1f s of one core a photo", report.seconds);
  if (report.simulated > 0)
    cost += format(", with %.0f simulated photos", report.simulated) +
            format("; %.0f %% were found unlike their own material", 100 * report.unlike);
  return cost + ".\n\n";
}

}  // namespace

bool is_covered(double share) {
  constexpr double kLeast = 0.85, kMost = 0.95, kRounding = 1e-9;
  return share > kLeast - kRounding && share < kMost + kRounding;
}

CalibrationReport report_of(const std::vector<std::string>& quantities,
                            const std::vector<PhotoOutcome>& outcomes) {
  CalibrationReport report;
  report.photos = static_cast<int>(outcomes.size());
  for (const PhotoOutcome& outcome : outcomes) {
    report.converged += outcome.worst_rhat <= kConverged;
    report.worst_rhat = std::max(report.worst_rhat, outcome.worst_rhat);
    report.seconds += outcome.seconds / report.photos;
    report.simulated += outcome.simulated / report.photos;
    report.unlike += (outcome.widening > 1) / static_cast<double>(report.photos);
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
  std::string table = "## " + title + "\n\n" + cost(report);
  table += "| | sd / prior sd | identified | 50 % | 80 % | 90 % | 95 % | chi-square of ranks (p) |\n";
  table += "|---|---|---|---|---|---|---|---|\n";
  for (const QuantityCoverage& quantity : report.quantities) table += line(quantity);
  return table;
}

}  // namespace patina
