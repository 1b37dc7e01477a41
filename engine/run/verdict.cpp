#include "engine/run/verdict.h"

#include <algorithm>
#include <cmath>

#include "engine/format.h"

namespace patina {
namespace {

/// R-hat of chains that sit in places of their own, whose sd together says nothing of what the photo knows.
constexpr double kApart = 1.1;

/// At most 1 when the quantity is good: the R-hat's excess or the lack of effective draws, whichever is
/// worse.
double badness(const QuantitySummary& q) {
  return std::max((q.rhat - 1) / (kGoodRhat - 1), kGoodEss / std::min(q.bulk_ess, q.tail_ess));
}

/// The chain whose mean is furthest from that of all, in words; empty where there is but one chain.
std::string chain_apart(const QuantitySummary& q) {
  if (q.chain_means.size() < 2) return "";
  const auto furthest = std::ranges::max_element(
      q.chain_means, {}, [&](const ChainMean& chain) { return std::abs(chain.mean - q.mean); });
  return "; chain " + std::to_string(furthest->chain + 1) + " is furthest apart, about " +
         format("%.3g", furthest->mean) + " where all together are about " + format("%.3g", q.mean);
}

std::string worst_direction(const RunSummary& summary) {
  const auto worst = std::ranges::max_element(summary.directions, {}, &DirectionSummary::rhat);
  if (worst == summary.directions.end() || !(worst->rhat > kGoodRhat)) return "";
  return "; of the directions in which the draws spread most the chains disagree most along " + worst->name +
         " (R-hat " + format("%.3f", worst->rhat) + ")";
}

}  // namespace

// A quantity that never changed has no R-hat: it is no evidence either way.
bool is_judged(const QuantitySummary& q) {
  const bool left_open = q.sd_over_prior_sd > kNotIdentified && q.rhat < kApart;
  return !std::isnan(q.rhat) && !left_open;
}

const QuantitySummary* furthest_from_good(const RunSummary& summary) {
  const QuantitySummary* worst = nullptr;
  for (const QuantitySummary& q : summary.quantities)
    if (is_judged(q) && (worst == nullptr || badness(q) > badness(*worst))) worst = &q;
  return worst;
}

bool chains_agree(const RunSummary& summary) {
  const QuantitySummary* worst = furthest_from_good(summary);
  return worst != nullptr && badness(*worst) <= 1;
}

std::string verdict(const RunSummary& summary) {
  const QuantitySummary* worst = furthest_from_good(summary);
  if (worst == nullptr) return "There are too few draws to say whether the chains agree.";
  const std::string evidence =
      worst->name + ", the furthest from it, has R-hat " + format("%.3f", worst->rhat) + " and " +
      format("%.0f", std::min(worst->bulk_ess, worst->tail_ess)) + " effective draws";
  const std::string goal =
      "R-hat " + format("%.2f", kGoodRhat) + " and " + format("%.0f", kGoodEss) + " effective draws";
  if (chains_agree(summary))
    return "The chains agree: every identified parameter has reached " + goal + " (" + evidence + ").";
  return "The chains do not agree yet to " + goal + ": " + evidence + chain_apart(*worst) +
         worst_direction(summary) + ". More draws help.";
}

}  // namespace patina
