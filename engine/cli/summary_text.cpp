#include "engine/cli/summary_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/format.h"
#include "engine/io/params_json.h"
#include "engine/material/off_values.h"
#include "engine/number_json.h"
#include "engine/run/advice.h"
#include "engine/run/all_alarms.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/verdict.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

Json quantity_json(const QuantitySummary& q) {
  return {{"mean", number_json(q.mean)},
          {"sd", number_json(q.sd)},
          {"q5", number_json(q.q5)},
          {"q25", number_json(q.q25)},
          {"q50", number_json(q.q50)},
          {"q75", number_json(q.q75)},
          {"q95", number_json(q.q95)},
          {"mcse_mean", number_json(q.mcse_mean)},
          {"mcse_sd", number_json(q.mcse_sd)},
          {"bulk_ess", number_json(q.bulk_ess)},
          {"tail_ess", number_json(q.tail_ess)},
          {"rhat", number_json(q.rhat)},
          {"sd_over_prior_sd", number_json(q.sd_over_prior_sd)}};
}

Json direction_json(const DirectionSummary& d, const ParameterTable& table) {
  Json loadings = Json::object();
  for (std::size_t i = 0; i < d.loadings.size(); ++i) loadings[table.continuous[i].name] = d.loadings[i];
  return {{"name", d.name},
          {"share", number_json(d.share)},
          {"bulk_ess", number_json(d.bulk_ess)},
          {"tail_ess", number_json(d.tail_ess)},
          {"rhat", number_json(d.rhat)},
          {"loadings", loadings}};
}

Json chain_json(const ChainSummary& c) {
  return {{"chain", c.chain + 1},
          {"draws", c.draws},
          {"acceptance", number_json(c.acceptance)},
          {"divergences", c.divergences},
          {"ebfmi", number_json(c.ebfmi)}};
}

Json advice_json(const ParameterAdvice& a) {
  return {{"name", a.name},
          {"identified", a.identified},
          {"redundant_with", a.redundant_with.empty() ? Json(nullptr) : Json(a.redundant_with)},
          {"off", a.off ? Json{{"value", a.off->value},
                               {"times_likelier", number_json(a.off->ratio)},
                               {"error", number_json(a.off->error)}}
                        : Json(nullptr)},
          {"freeze_at", a.freeze_at ? number_json(*a.freeze_at) : Json(nullptr)},
          {"sentence", a.sentence}};
}

std::vector<ParameterAdvice> advice_of(const DrawSource& run, const std::vector<Draw>& draws) {
  return advise(run.table(), draws, off_values(run.table().material));
}

std::int64_t total_draws(const RunSummary& summary) {
  std::int64_t total = 0;
  for (const ChainSummary& chain : summary.chains) total += chain.draws;
  return total;
}

Json map_json(const DrawSource& run, const RunStatus& status) {
  if (!status.best) return nullptr;
  return {{"values", Json::parse(params_to_json(run.table(), *status.best))},
          {"lp", number_json(status.best_lp)}};
}

Alarms alarms_of(const DrawSource& run, const RunSummary& summary) {
  return all_alarms(run.settings(), run.table(), run.status(), summary);
}

Json alarms_json(const Alarms& alarms) {
  Json json = Json::array();
  for (const Alarm& alarm : alarms) json.push_back({{"name", alarm.name}, {"sentence", alarm.sentence}});
  return json;
}

/// Four significant digits, right-aligned; a dash where there is no number.
std::string cell(double value, int width = 10) {
  return std::isfinite(value) ? format("%*.4g", width, value) : format("%*s", width, "-");
}

std::string name_cell(const std::string& name) {
  return name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ');
}

std::string quantity_line(const QuantitySummary& q) {
  return name_cell(q.name) + cell(q.mean) + cell(q.sd) + cell(q.q5) + cell(q.q50) + cell(q.q95) +
         cell(q.mcse_mean) + cell(q.bulk_ess) + cell(q.tail_ess) + cell(q.rhat) +
         (q.sd_over_prior_sd > 0.9 ? "   not pinned down by this photo\n" : "\n");
}

/// Only the columns that a direction has; its name stands at the end, since it may be long.
std::string direction_line(const DirectionSummary& d) {
  return name_cell("direction") + std::string(60, ' ') + cell(d.bulk_ess) + cell(d.tail_ess) + cell(d.rhat) +
         "   " + d.name + "\n";
}

}  // namespace

Json summary_json(const DrawSource& run, const std::vector<Draw>& draws) {
  const RunStatus status = run.status();
  const RunSummary summary = summarize_draws(run.table(), draws);
  Json parameters = Json::object(), directions = Json::array(), chains = Json::array(),
       advice = Json::array();
  for (std::size_t i = 1; i < summary.quantities.size(); ++i)
    parameters[summary.quantities[i].name] = quantity_json(summary.quantities[i]);
  for (const DirectionSummary& direction : summary.directions)
    directions.push_back(direction_json(direction, run.table()));
  for (const ChainSummary& chain : summary.chains) chains.push_back(chain_json(chain));
  for (const ParameterAdvice& a : advice_of(run, draws)) advice.push_back(advice_json(a));
  return {{"directory", run.directory().string()},
          {"phase", phase_word(status.phase)},
          {"message", status.message},
          {"material", run.settings().material},
          {"draws", total_draws(summary)},
          {"map", map_json(run, status)},
          {"lp", quantity_json(summary.quantities.front())},
          {"parameters", parameters},
          {"directions", directions},
          {"verdict", verdict(summary)},
          {"alarms", alarms_json(alarms_of(run, summary))},
          {"advice", advice},
          {"chains", chains}};
}

std::string summary_table(const DrawSource& run, const std::vector<Draw>& draws) {
  const RunSummary summary = summarize_draws(run.table(), draws);
  std::string text = name_cell("");
  for (const char* title : {"mean", "sd", "5%", "50%", "95%", "MCSE", "bulk ESS", "tail ESS", "R-hat"})
    text += format("%10s", title);
  text += "\n";
  for (const QuantitySummary& quantity : summary.quantities) text += quantity_line(quantity);
  for (const DirectionSummary& direction : summary.directions) text += direction_line(direction);
  for (const ChainSummary& chain : summary.chains)
    text += "chain " + std::to_string(chain.chain + 1) + ": " + std::to_string(chain.draws) +
            " draws, acceptance " + cell(chain.acceptance, 6) + ", " + std::to_string(chain.divergences) +
            " divergences\n";
  text += verdict(summary) + "\n";
  for (const Alarm& alarm : alarms_of(run, summary)) text += "Mind: " + alarm.sentence + "\n";
  for (const ParameterAdvice& a : advice_of(run, draws))
    if (!a.sentence.empty()) text += a.sentence + "\n";
  return text;
}

}  // namespace patina
