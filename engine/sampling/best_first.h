#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace patina {

/// @tparam State  with an evaluation
template <typename State>
void sort_best_first(std::vector<State>& states) {
  std::ranges::stable_sort(states, std::ranges::greater{},
                           [](const State& state) { return state.evaluation.log_density; });
}

/// Nats below the best, a thousandth of its density, up to which a place is about as good: some hundredths of
/// a posterior may lie there.
constexpr double kAsGood = 7;

/// How many, beginning with the best, are about as good as it.
/// @param states  best first   @param behind  nats   @return at least 1
template <typename State>
std::size_t as_good(const std::vector<State>& states, double behind = kAsGood) {
  const auto first_behind = std::ranges::find_if(states, [&](const State& state) {
    return state.evaluation.log_density < states.front().evaluation.log_density - behind;
  });
  return std::max<std::size_t>(static_cast<std::size_t>(first_behind - states.begin()), 1);
}

}  // namespace patina
