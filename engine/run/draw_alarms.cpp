#include "engine/run/draw_alarms.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/diagnostics/modes.h"
#include "engine/format.h"
#include "engine/posterior/prior_transform.h"

namespace patina {
namespace {

using Chains = std::vector<std::vector<const Draw*>>;

std::string percent(double share) {
  return share < 0.1 ? format("%.1f %%", 100 * share) : format("%.0f %%", 100 * share);
}

std::string number(double value) { return format("%.3g", value); }

std::optional<Alarm> alone(const RunSummary& summary) {
  if (summary.chains.size() != 1) return std::nullopt;
  return Alarm{"alone",
               "One chain cannot show whether it found every kind of match: draw four (--chains 4)."};
}

bool never_moved(const std::vector<const Draw*>& chain) {
  return chain.size() > 1 &&
         std::ranges::all_of(chain, [&](const Draw* draw) { return draw->values == chain.front()->values; });
}

std::optional<Alarm> stuck(const Chains& chains) {
  std::string names;
  for (std::size_t k = 0; k < chains.size(); ++k)
    if (never_moved(chains[k])) names += (names.empty() ? "" : ", ") + std::to_string(k + 1);
  if (names.empty()) return std::nullopt;
  return Alarm{"stuck",
               "These chains never moved: " + names +
                   ". Their draws are one place, not a spread: let them walk for longer first (--warmup)."};
}

/// Some of the draws, in order, and of which chain each is.
struct Thinned {
  std::vector<const Draw*> draws;
  std::vector<std::size_t> chains;
};

/// Every so many: passages there and back between two of them are not seen.
Thinned thinned(const Chains& chains) {
  constexpr std::size_t kMost = 4000;
  std::size_t total = 0;
  for (const auto& chain : chains) total += chain.size();
  const std::size_t step = total / kMost + 1;
  Thinned some;
  for (std::size_t k = 0; k < chains.size(); ++k)
    for (std::size_t i = 0; i < chains[k].size(); i += step) {
      some.draws.push_back(chains[k][i]);
      some.chains.push_back(k);
    }
  return some;
}

std::vector<Mode> modes_of(const Thinned& some, const ParameterTable& table) {
  const auto rows = std::ssize(some.draws);
  Eigen::MatrixXd continuous(rows, std::ssize(table.continuous));
  Eigen::MatrixXi discrete(rows, std::ssize(table.discrete));
  for (std::size_t j = 0; j < table.continuous.size(); ++j) {
    const PriorTransform transform(table.continuous[j].prior);
    for (Eigen::Index i = 0; i < rows; ++i)
      continuous(i, static_cast<Eigen::Index>(j)) =
          transform.coordinate(some.draws[static_cast<std::size_t>(i)]->values.continuous[j]);
  }
  for (std::size_t j = 0; j < table.discrete.size(); ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      discrete(i, static_cast<Eigen::Index>(j)) = some.draws[static_cast<std::size_t>(i)]->values.discrete[j];
  return find_modes(continuous, discrete);
}

/// How often a chain went into a mode, or out of it, between two of its draws.
int passages(const Mode& mode, const Thinned& some) {
  std::vector<bool> inside(some.draws.size(), false);
  for (const Eigen::Index member : mode.members) inside[static_cast<std::size_t>(member)] = true;
  int count = 0;
  for (std::size_t i = 1; i < inside.size(); ++i)
    count += some.chains[i] == some.chains[i - 1] && inside[i] != inside[i - 1];
  return count;
}

std::optional<Alarm> separate_modes(const Chains& chains, const ParameterTable& table) {
  constexpr int kFewest = 40;  // passages: a share of a half is then known to about 0.1
  const Thinned some = thinned(chains);
  const std::vector<Mode> modes = modes_of(some, table);
  if (modes.size() < 2) return std::nullopt;
  int fewest = passages(modes.front(), some);
  for (const Mode& mode : modes) fewest = std::min(fewest, passages(mode, some));
  if (fewest >= kFewest) return std::nullopt;
  std::string shares;
  for (std::size_t i = 0; i < std::min<std::size_t>(modes.size(), 4); ++i)
    shares += (i == 0 ? "" : ", ") +
              percent(static_cast<double>(modes[i].members.size()) / static_cast<double>(some.draws.size()));
  return Alarm{
      "modes",
      "There are " + std::to_string(modes.size()) + " separate kinds of match (" + shares +
          " of the draws), and chains passed into or out of one of them only " + std::to_string(fewest) +
          " times: how likely each is, is not known. A ladder to the prior weighs them (--temper 8)."};
}

std::optional<Alarm> divergences(const RunSummary& summary) {
  const ChainSummary* worst = nullptr;
  const auto share = [](const ChainSummary& chain) {
    return static_cast<double>(chain.divergences) /
           static_cast<double>(std::max<std::int64_t>(chain.draws, 1));
  };
  for (const ChainSummary& chain : summary.chains)
    if (worst == nullptr || share(chain) > share(*worst)) worst = &chain;
  if (worst == nullptr || !(share(*worst) > kMostDivergent)) return std::nullopt;
  return Alarm{"divergences", percent(share(*worst)) + " of chain " + std::to_string(worst->chain + 1) +
                                  "'s steps met a cliff and were broken off: places that it should have "
                                  "reached may be missing. Compare with random walks (--kernel mh)."};
}

std::optional<Alarm> energy(const RunSummary& summary) {
  for (const ChainSummary& chain : summary.chains)
    if (chain.has_trajectories && chain.ebfmi < kLeastEbfmi)
      return Alarm{"energy", "Chain " + std::to_string(chain.chain + 1) +
                                 " goes between good and poor matches too slowly (E-BFMI " +
                                 number(chain.ebfmi) + "): its intervals may be too narrow. Draw more."};
  return std::nullopt;
}

/// The share of draws, and of the prior, within the last part of the range before a bound.
struct Pile {
  double drawn = 0, prior = 0;
};

Pile pile_at(const Chains& chains, std::size_t parameter, const TruncatedNormal& prior, bool upper) {
  constexpr double kEdge = 0.02;  // of the range
  const double width = kEdge * (prior.high - prior.low);
  const double edge = upper ? prior.high - width : prior.low + width;
  std::size_t inside = 0, total = 0;
  for (const auto& chain : chains)
    for (const Draw* draw : chain) {
      const double value = draw->values.continuous[parameter];
      inside += upper ? value > edge : value < edge;
      ++total;
    }
  const double u = PriorTransform(prior).coordinate(edge);
  return {static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(total, 1)),
          0.5 * std::erfc((upper ? u : -u) / std::sqrt(2.0))};
}

/// One sentence a parameter: others may be well within their bounds.
void add_bounds(const Chains& chains, const ParameterTable& table, Alarms& alarms) {
  constexpr double kPiled = 0.3;   // of the draws
  constexpr double kSurprise = 3;  // times what the prior has there
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    const Parameter& parameter = table.continuous[i];
    for (const bool upper : {false, true}) {
      const Pile pile = pile_at(chains, i, parameter.prior, upper);
      if (pile.drawn < kPiled || pile.drawn < kSurprise * pile.prior) continue;
      const double bound = upper ? parameter.prior.high : parameter.prior.low;
      alarms.push_back({"bound", percent(pile.drawn) + " of the draws of " + parameter.name +
                                     " are piled at its " + (upper ? "upper" : "lower") + " bound " +
                                     number(bound) + ": the photo may want a wider prior of it (--prior)."});
    }
  }
}

}  // namespace

Alarms draw_alarms(const ParameterTable& table, const RunSummary& summary, const Chains& chains) {
  Alarms alarms;
  for (const auto& alarm :
       {alone(summary), stuck(chains), separate_modes(chains, table), divergences(summary), energy(summary)})
    if (alarm) alarms.push_back(*alarm);
  add_bounds(chains, table, alarms);
  return alarms;
}

}  // namespace patina
