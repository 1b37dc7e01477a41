#include "engine/stress/suite.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <utility>

#include "engine/error.h"
#include "engine/sampling/parallel_for.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

Cell try_cell(const Scenario& scenario, const std::string& kernel, std::uint64_t seed) {
  Cell cell{scenario.name, scenario.what, scenario.known_by, kernel, {}, {}};
  try {
    cell.evidence = scenario.attempt({.kernel = kernel, .seed = seed});
  } catch (const UserError& error) {
    cell.evidence.refusal = error.what();
  }
  cell.outcome = outcome(cell.evidence);
  cell.is_limit = scenario.is_limit;
  return cell;
}

}  // namespace

std::vector<Scenario> density_scenarios() {
  std::vector<Scenario> all;
  for (auto* list : {bound_scenarios, ridge_scenarios, mode_scenarios, edge_scenarios, precision_scenarios,
                     start_scenarios})
    std::ranges::move(list(), std::back_inserter(all));
  return all;
}

std::vector<Cell> try_all(const std::vector<Scenario>& scenarios, const SuiteSettings& settings) {
  const std::size_t kernels = settings.kernels.size();
  std::vector<Cell> cells(scenarios.size() * kernels);
  std::mutex mutex;
  parallel_for(cells.size(), settings.threads, [&](std::size_t i) {
    cells[i] = try_cell(scenarios[i / kernels], settings.kernels[i % kernels], settings.seed);
    const std::lock_guard lock(mutex);
    if (settings.tried) settings.tried(cells[i]);
  });
  return cells;
}

}  // namespace patina
