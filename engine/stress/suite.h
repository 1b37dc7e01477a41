#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/stress/judge.h"
#include "engine/stress/scenario.h"

namespace patina {

/// A scenario tried with a kernel.
struct Cell {
  std::string scenario, what, known_by, kernel;
  Evidence evidence;
  Outcome outcome = Outcome::right;
  bool is_limit = false;

  /// Wrong without a sign where there should have been one.
  bool is_defect() const { return outcome == Outcome::silent && !is_limit; }
};

struct SuiteSettings {
  std::vector<std::string> kernels;
  std::uint64_t seed = 1;
  int threads = 1;                              ///< cells at a time; the cells are the same
  std::function<void(const Cell&)> tried = {};  ///< called after each, one at a time; may be empty
};

/// All densities whose answer is known; photos say photo_scenarios().
std::vector<Scenario> density_scenarios();

/// Tries every scenario with every kernel. What is refused with a UserError is an outcome.
std::vector<Cell> try_all(const std::vector<Scenario>& scenarios, const SuiteSettings& settings);

}  // namespace patina
