#pragma once

#include <string>
#include <vector>

#include "engine/calibration/coverage.h"
#include "engine/calibration/study.h"

namespace patina {

constexpr double kConverged = 1.05;  ///< R-hat of short chains, at most

/// One quantity over all photos.
struct QuantityCoverage {
  std::string name;
  double sd_over_prior_sd = 0;  ///< mean over photos; NaN for lp
  bool identified = false;      ///< below 0.9; always for lp
  Coverage coverage;            ///< of all photos, converged or not

  bool is_parameter() const { return sd_over_prior_sd == sd_over_prior_sd; }
};

/// Whether a 90 % interval that holds this share of the truths does what is asked of it: 85 to 95 %.
bool is_covered(double share);

struct CalibrationReport {
  int photos = 0, converged = 0;
  double seconds = 0;     ///< mean of a photo, of one core
  double simulated = 0;   ///< photos a photo, on average; 0: hand-set errors
  double worst_rhat = 0;  ///< of all photos
  double unlike = 0;      ///< share of photos that were found to be unlike their own material
  std::vector<QuantityCoverage> quantities;
};

CalibrationReport report_of(const std::vector<std::string>& quantities,
                            const std::vector<PhotoOutcome>& outcomes);

/// A table in Markdown, with a title and a line on convergence and cost. Coverage of the 90 % interval of an
/// identified parameter that is not from 85 to 95 % is in bold.
std::string to_markdown(const CalibrationReport& report, const std::string& title);

}  // namespace patina
