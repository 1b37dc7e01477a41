#include "engine/cli/draw_choice.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "engine/error.h"

namespace patina {
namespace {

ParameterValues map_values(const DrawSource& run) {
  const RunStatus status = run.status();
  if (!status.best)
    throw UserError("The run in " + run.directory().string() +
                    " has found no match yet: wait, or start it again.");
  return *status.best;
}

/// The most frequent level; the lower one of a tie.
int most_frequent(const std::vector<const Draw*>& draws, std::size_t discrete, std::size_t levels) {
  std::vector<std::size_t> counts(levels);
  for (const Draw* draw : draws) ++counts[static_cast<std::size_t>(draw->values.discrete[discrete])];
  return static_cast<int>(std::ranges::max_element(counts) - counts.begin());
}

ParameterValues mean_values(const DrawSource& run, const std::vector<Draw>& draws) {
  std::vector<const Draw*> kept;
  for (const Draw& draw : draws)
    if (!draw.warmup) kept.push_back(&draw);
  if (kept.empty())
    throw UserError("The run in " + run.directory().string() +
                    " has no draws after warm-up to take the mean of: use --draw map.");
  ParameterValues mean;
  for (std::size_t i = 0; i < run.table().continuous.size(); ++i) {
    double sum = 0;
    for (const Draw* draw : kept) sum += draw->values.continuous[i];
    mean.continuous.push_back(sum / static_cast<double>(kept.size()));
  }
  for (std::size_t i = 0; i < run.table().discrete.size(); ++i)
    mean.discrete.push_back(most_frequent(kept, i, run.table().discrete[i].levels.size()));
  return mean;
}

bool parse_count(std::string_view text, std::int64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

ParameterValues numbered_values(const std::string& choice, const DrawSource& run,
                                const std::vector<Draw>& draws) {
  const auto colon = choice.find(':');
  std::int64_t chain = 0, number = 0;
  if (colon == std::string::npos || !parse_count(std::string_view(choice).substr(0, colon), chain) ||
      !parse_count(std::string_view(choice).substr(colon + 1), number))
    throw UserError("'--draw " + choice + "' is not understood: use map, mean or CHAIN:DRAW, as in 1:600.");
  const auto found = std::ranges::find_if(
      draws, [&](const Draw& draw) { return draw.chain + 1 == chain && draw.iteration + 1 == number; });
  if (found == draws.end())
    throw UserError("There is no draw " + choice + " in " + run.directory().string() +
                    ": chains and draws are counted from 1, warm-up included.");
  return found->values;
}

}  // namespace

ParameterValues choose_draw(const std::string& choice, const DrawSource& run,
                            const std::vector<Draw>& draws) {
  if (choice == "map") return map_values(run);
  if (choice == "mean") return mean_values(run, draws);
  return numbered_values(choice, run, draws);
}

}  // namespace patina
