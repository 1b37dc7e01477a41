#include "engine/run/all_alarms.h"

#include <algorithm>

#include "engine/format.h"
#include "engine/run/verdict.h"

namespace patina {
namespace {

bool is_wrinkled(const RunSettings& settings, const ParameterTable& table) {
  return settings.errors != "calibrated" &&
         std::ranges::any_of(table.continuous, [&](const Parameter& parameter) {
           return parameter.jagged && !settings.fixed.contains(parameter.name);
         });
}

}  // namespace

std::optional<Alarm> apart_alarm(const RunSettings& settings, const ParameterTable& table,
                                 const RunSummary& summary) {
  const bool enough = std::ranges::all_of(
      summary.chains, [](const ChainSummary& chain) { return chain.draws >= kApartDraws; });
  const QuantitySummary* worst = furthest_from_good(summary);
  if (!is_wrinkled(settings, table) || !enough || worst == nullptr || !(worst->rhat > kApartRhat))
    return std::nullopt;
  return Alarm{"apart", "Chains sit in matches of their own (R-hat " + format("%.2f", worst->rhat) + " of " +
                            worst->name + "): places of the texture that look alike each make one. " +
                            (settings.errors != "averaged"
                                 ? "Averaged over irregularities (--errors averaged) they are one; errors"
                                 : "Errors") +
                            " learnt from simulated photos (--errors calibrated) average over them, too, and "
                            "usually let chains agree within a minute or two."};
}

Alarms all_alarms(const RunSettings& settings, const ParameterTable& table, const RunStatus& status,
                  const RunSummary& summary) {
  Alarms alarms = status.alarms;
  alarms.insert(alarms.end(), summary.alarms.begin(), summary.alarms.end());
  if (const std::optional<Alarm> apart = apart_alarm(in_force(settings, status), table, summary))
    alarms.push_back(*apart);
  return alarms;
}

}  // namespace patina
