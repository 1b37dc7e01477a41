#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/run/draw.h"
#include "engine/run/summarize.h"

namespace patina {

/// A quantity of the draws whose posterior mean and sd are known another way.
struct Known {
  std::string name;
  std::function<double(const ParameterValues&)> of;
  double mean = 0, sd = 1;
};

/// How a scenario is to be tried.
struct Attempt {
  std::string kernel = "hmc";
  std::uint64_t seed = 1;
  int threads = 1;
};

/// How far a run's answer is from the known one, in posterior sds.
struct Error {
  std::string name;  ///< of the quantity that is furthest off
  double size = 0;
  double mcse = 0;  ///< as the draws themselves say
};

/// An answer is wrong if a mean is further from the known one than so many posterior sds, or if the sd is off
/// by that share: five Monte Carlo standard errors at the effective draws that the verdict asks for.
constexpr double kWrong = 0.25;

/// What a run says of itself, and how far it is from what is known.
struct Evidence {
  RunSummary summary;
  std::vector<Alarm> alarms;  ///< of the draws and of the run
  Error error;
  double limit = kWrong;  ///< of the error; of a photo 3: its truth lies within three posterior sds
  bool is_short = false;  ///< a run too short for R-hat and ESS: that they are poor is no alarm
  double seconds = 0;     ///< of wall time
  std::string refusal;    ///< the sentence with which it was refused; empty: it was run
};

/// One known way to fail. Its name is what `patina-cli stress --scenario` takes.
struct Scenario {
  std::string name;
  std::string what;      ///< one line
  std::string known_by;  ///< "closed form", "quadrature", "render"
  std::function<Evidence(const Attempt&)> attempt;
  bool is_limit =
      false;  ///< nothing that has not met the answer can tell: a silent error is shown, not counted
};

}  // namespace patina
