#include "engine/run/stop_rules.h"

#include <algorithm>

#include "engine/format.h"
#include "engine/run/verdict.h"

namespace patina {
StopEvidence stop_evidence(const RunSummary& summary) {
  StopEvidence evidence;
  for (const ChainSummary& chain : summary.chains) evidence.draws += chain.draws;
  for (const QuantitySummary& q : summary.quantities) {
    if (!is_judged(q)) continue;
    const double ess = std::min(q.bulk_ess, q.tail_ess);
    if (evidence.least_ess_of.empty() || ess < evidence.least_ess) {
      evidence.least_ess_of = q.name;
      evidence.least_ess = ess;
    }
    if (evidence.largest_rhat_of.empty() || q.rhat > evidence.largest_rhat) {
      evidence.largest_rhat_of = q.name;
      evidence.largest_rhat = q.rhat;
    }
  }
  return evidence;
}

bool is_reached(const StopRules& rules, const StopEvidence& evidence) {
  if (!rules.ask_for_quality() || evidence.least_ess_of.empty()) return false;
  return (rules.ess <= 0 || evidence.least_ess >= rules.ess) &&
         (rules.rhat <= 0 || evidence.largest_rhat <= rules.rhat);
}

bool is_safely_reached(const StopRules& rules, const StopEvidence& evidence) {
  constexpr double kMoreEss = 1.05, kOfExcess = 0.9;  // of the R-hat that is asked for, beyond 1
  StopRules more = rules;
  more.ess *= kMoreEss;
  if (more.rhat > 0) more.rhat = 1 + kOfExcess * (more.rhat - 1);
  return is_reached(more, evidence);
}

std::string in_words(const StopRules& rules, const StopEvidence& evidence) {
  if (evidence.least_ess_of.empty()) return "there are too few draws to judge them by the goal";
  std::string text = is_reached(rules, evidence) ? "the goal is reached: " : "the goal is not reached: ";
  if (rules.ess > 0)
    text += "the fewest effective draws are " + format("%.0f", evidence.least_ess) + " (" +
            evidence.least_ess_of + "; " + format("%g", rules.ess) + " asked for)";
  if (rules.ess > 0 && rules.rhat > 0) text += ", ";
  if (rules.rhat > 0)
    text += "the largest R-hat is " + format("%.4f", evidence.largest_rhat) + " (" +
            evidence.largest_rhat_of + "; " + format("%g", rules.rhat) + " asked for)";
  return text;
}

}  // namespace patina
