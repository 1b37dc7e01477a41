#pragma once

#include <string>
#include <vector>

#include "engine/stress/scenario.h"

namespace patina {

/// How a scenario ended.
enum class Outcome {
  right,    ///< the known answer
  alarmed,  ///< another one, or an unreliable one, and the run said so
  refused,  ///< not run, with one sentence that says why
  silent,   ///< another one, and nothing said so: a defect
};

std::string word(Outcome outcome);

Outcome outcome(const Evidence& evidence);

/// The names of what was said against the run: its alarms, and "unconverged" where the verdict is not that
/// the chains agree.
std::vector<std::string> warnings(const Evidence& evidence);

/// The quantity whose mean or sd (as a logarithm of their ratio) is furthest from what is known; infinite
/// where the draws have none.
Error worst_error(const std::vector<Known>& known, const std::vector<Draw>& draws);

}  // namespace patina
