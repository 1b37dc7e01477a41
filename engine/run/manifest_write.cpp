#include <nlohmann/json.hpp>

#include "engine/number_json.h"
#include "engine/run/manifest.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/table_json.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

Json priors_json(const std::map<std::string, TruncatedNormal>& priors) {
  Json json = Json::object();
  for (const auto& [name, prior] : priors) json[name] = prior_json(prior);
  return json;
}

Json settings_json(const RunSettings& s) {
  return {{"resolution", s.resolution},
          {"summary", s.summary},
          {"network", s.network.string()},
          {"precision", s.precision},
          {"device", s.device},
          {"errors", s.errors},
          {"kernel", s.kernel},
          {"metric", s.metric},
          {"discrete", s.discrete},
          {"chains", s.chains},
          {"warmup", s.warmup.value()},
          {"draws", s.draws},
          {"alpha", s.alpha},
          {"refresh", s.refresh.value()},
          {"path_length", s.path_length},
          {"temper", s.temper},
          {"start", s.start},
          {"start_at", Json(s.start_at)},
          {"seed", s.seed},
          {"z_seed", s.z_seed},
          {"map_only", s.map_only},
          {"fixed", Json(s.fixed)},
          {"priors", priors_json(s.priors)},
          {"stop", {{"minutes", s.stop.minutes}, {"ess", s.stop.ess}, {"rhat", s.stop.rhat}}}};
}

Json point_json(const MapPoint& point, const ParameterTable& table) {
  Json values = Json::object();
  for (std::size_t i = 0; i < table.continuous.size(); ++i)
    values[table.continuous[i].name] = point.values.continuous[i];
  for (std::size_t i = 0; i < table.discrete.size(); ++i)
    values[table.discrete[i].name] = point.values.discrete[i];
  return {{"values", values}, {"lp", number_json(point.lp)}};
}

Json map_json(const Manifest& m) { return m.map ? point_json(*m.map, m.table) : Json(nullptr); }

Json basins_json(const Manifest& m) {
  Json basins = Json::array();
  for (const MapPoint& basin : m.basins) basins.push_back(point_json(basin, m.table));
  return basins;
}

/// A central crop is left out, as it was before there were others.
Json photo_json(const Manifest& m) {
  Json json = {{"sha256", m.photo_sha256},
               {"width", m.photo_width},
               {"height", m.photo_height},
               {"warnings", m.photo_warnings}};
  if (m.crop) json["crop"] = {{"x", m.crop->x}, {"y", m.crop->y}, {"side", m.crop->side}};
  return json;
}

Json alarms_json(const Alarms& alarms) {
  Json json = Json::array();
  for (const Alarm& alarm : alarms) json.push_back({{"name", alarm.name}, {"sentence", alarm.sentence}});
  return json;
}

Json evidence_json(const std::optional<StopEvidence>& evidence) {
  if (!evidence) return nullptr;
  return {{"draws", evidence->draws},
          {"least_ess", number_json(evidence->least_ess)},
          {"least_ess_of", evidence->least_ess_of},
          {"largest_rhat", number_json(evidence->largest_rhat)},
          {"largest_rhat_of", evidence->largest_rhat_of}};
}

Json photo_fit_json(const std::optional<PhotoFit>& fit) {
  if (!fit) return nullptr;
  return {{"distance", number_json(fit->distance)},
          {"p", number_json(fit->p)},
          {"widening", number_json(fit->widening)},
          {"discrepancy", number_json(fit->discrepancy)}};
}

}  // namespace

std::string to_json(const Manifest& m) {
  Json json = {
      {"format", kRunFormat},
      {"program", m.program},
      {"phase", phase_word(m.phase)},
      {"reason", m.reason},
      {"photo", photo_json(m)},
      {"capture", {{"size_cm", m.settings.capture.size_cm}, {"camera_cm", m.settings.capture.camera_cm}}},
      {"material", table_json(m.table)},
      {"settings", settings_json(m.settings)},
      {"network_sha256", m.network_sha256},
      {"error_model", {{"gram_sigma", m.gram_sigma}, {"mean_sigma", m.mean_sigma}}},
      {"photo_fit", photo_fit_json(m.photo_fit)},
      {"map", map_json(m)},
      {"basins", basins_json(m)},
      {"alarms", alarms_json(m.alarms)},
      {"seconds",
       {{"search", m.seconds.search}, {"warmup", m.seconds.warmup}, {"sampling", m.seconds.sampling}}},
      {"evidence", evidence_json(m.evidence)}};
  if (!m.kernel.empty()) json["kernel"] = m.kernel;
  if (!m.errors.empty()) json["errors"] = m.errors;
  if (m.warmup) json["warmup"] = *m.warmup;
  if (m.so_far && !m.map) json["so_far"] = point_json(*m.so_far, m.table);
  // A file name need not be UTF-8; the manifest must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace patina
