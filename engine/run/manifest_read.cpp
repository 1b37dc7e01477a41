#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/manifest.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run_checks.h"
#include "engine/run/run_files.h"
#include "engine/summary/device.h"
#include "engine/summary/precision.h"

namespace patina {
namespace {

using AnyJson = nlohmann::json;

constexpr std::size_t kLongestList = 10'000;

/// What is wrong with a field, without the file's name.
struct BadField {
  std::string why;
};

const AnyJson& field(const AnyJson& json, const char* key) {
  if (!json.is_object() || !json.contains(key)) throw BadField{"'" + std::string(key) + "' is missing"};
  return json[key];
}

std::string text(const AnyJson& json, const char* key) {
  const AnyJson& value = field(json, key);
  if (!value.is_string()) throw BadField{"'" + std::string(key) + "' is not text"};
  return value.get<std::string>();
}

double number(const AnyJson& json, const char* key) {
  const AnyJson& value = field(json, key);
  if (!value.is_number()) throw BadField{"'" + std::string(key) + "' is not a number"};
  return value.get<double>();
}

double positive(const AnyJson& json, const char* key) {
  const double value = number(json, key);
  if (!(value > 0 && std::isfinite(value))) throw BadField{"'" + std::string(key) + "' is out of range"};
  return value;
}

int integer(const AnyJson& json, const char* key, int low, int high = std::numeric_limits<int>::max()) {
  const double value = number(json, key);
  if (!(value >= low && value <= high && value == std::floor(value)))
    throw BadField{"'" + std::string(key) + "' is out of range"};
  return static_cast<int>(value);
}

std::uint64_t seed(const AnyJson& json, const char* key) {
  const AnyJson& value = field(json, key);
  if (!value.is_number_unsigned()) throw BadField{"'" + std::string(key) + "' is not a seed"};
  return value.get<std::uint64_t>();
}

const AnyJson& list(const AnyJson& json, const char* key) {
  const AnyJson& value = field(json, key);
  if (!value.is_array() || value.size() > kLongestList)
    throw BadField{"'" + std::string(key) + "' is not a list"};
  return value;
}

std::vector<std::string> texts(const AnyJson& json, const char* key) {
  std::vector<std::string> result;
  for (const AnyJson& item : list(json, key)) {
    if (!item.is_string()) throw BadField{"'" + std::string(key) + "' holds something that is not text"};
    result.push_back(item.get<std::string>());
  }
  return result;
}

TruncatedNormal prior(const AnyJson& json) {
  const TruncatedNormal prior{number(json, "mean"), positive(json, "sd"), number(json, "low"),
                              number(json, "high")};
  if (!(prior.low < prior.high)) throw BadField{"a prior's low is not below its high"};
  try {
    PriorTransform{prior};
  } catch (const UserError&) {
    throw BadField{"a prior has next to no mass between its low and its high"};
  }
  return prior;
}

ParameterTable table(const AnyJson& json) {
  ParameterTable table;
  table.material = text(json, "name");
  table.description = text(json, "description");
  if (json.contains("summary")) table.summary = text(json, "summary");
  for (const AnyJson& item : list(json, "continuous"))
    table.continuous.push_back(
        {text(item, "name"), text(item, "unit"), text(item, "description"), prior(field(item, "prior"))});
  for (const AnyJson& item : list(json, "discrete")) {
    table.discrete.push_back({text(item, "name"), text(item, "description"), texts(item, "levels")});
    if (table.discrete.back().levels.empty()) throw BadField{"a choice has no levels"};
  }
  return table;
}

std::map<std::string, double> named_numbers(const AnyJson& json, const char* key) {
  std::map<std::string, double> result;
  for (const auto& [name, value] : field(json, key).items()) {
    if (!value.is_number()) throw BadField{"'" + std::string(key) + "' holds something that is not a number"};
    result[name] = value.get<double>();
  }
  return result;
}

/// Of a setting that runs of earlier versions have none of: theirs is `usual`.
std::string one_of(const AnyJson& json, const char* key, const std::vector<std::string>& known,
                   const std::string& usual) {
  if (!json.contains(key)) return usual;
  const std::string name = text(json, key);
  if (std::ranges::find(known, name) == known.end())
    throw BadField{"'" + std::string(key) + "' is '" + name.substr(0, 40) + "', which is unknown"};
  return name;
}

RunSettings settings(const AnyJson& json) {
  RunSettings s;
  s.resolution = integer(json, "resolution", 1);
  s.summary = text(json, "summary");
  s.network = text(json, "network");
  s.kernel = text(json, "kernel");
  s.precision = one_of(json, "precision", precision_names(), s.precision);
  s.device = one_of(json, "device", device_names(), s.device);
  s.errors = one_of(json, "errors", asked_error_names(), "paper");  // earlier runs know no others
  if (json.contains("metric")) s.metric = text(json, "metric");     // runs of the first version have none
  if (json.contains("discrete")) s.discrete = text(json, "discrete");
  s.chains = integer(json, "chains", 1, 10'000);
  s.warmup = integer(json, "warmup", 0);
  s.draws = integer(json, "draws", 0);
  s.alpha = number(json, "alpha");
  s.refresh = number(json, "refresh");
  s.seed = seed(json, "seed");
  s.z_seed = seed(json, "z_seed");
  const AnyJson& map_only = field(json, "map_only");
  if (!map_only.is_boolean()) throw BadField{"'map_only' is not true or false"};
  s.map_only = map_only.get<bool>();
  s.fixed = named_numbers(json, "fixed");
  for (const auto& [name, value] : field(json, "priors").items()) s.priors[name] = prior(value);
  if (json.contains("path_length")) s.path_length = number(json, "path_length");
  if (json.contains("temper")) s.temper = integer(json, "temper", 0, kMostRungs);
  if (json.contains("start")) s.start = text(json, "start");
  if (json.contains("start_at")) s.start_at = named_numbers(json, "start_at");
  if (json.contains("stop"))
    s.stop = {number(json["stop"], "minutes"), number(json["stop"], "ess"), number(json["stop"], "rhat")};
  return s;
}

std::optional<StopEvidence> evidence(const AnyJson& json) {
  if (json.is_null()) return std::nullopt;
  StopEvidence evidence;
  evidence.draws = integer(json, "draws", 0);
  evidence.least_ess = number(json, "least_ess");
  evidence.least_ess_of = text(json, "least_ess_of");
  evidence.largest_rhat = number(json, "largest_rhat");
  evidence.largest_rhat_of = text(json, "largest_rhat_of");
  return evidence;
}

std::optional<PhotoFit> photo_fit(const AnyJson& json) {
  if (json.is_null()) return std::nullopt;
  const PhotoFit fit{positive(json, "distance"), positive(json, "p"), positive(json, "widening"),
                     number(json, "discrepancy")};
  if (fit.p > 1 || fit.widening < 1 || (fit.discrepancy != 0 && fit.discrepancy != 1))
    throw BadField{"'photo_fit' is out of range"};
  return fit;
}

MapPoint map_point(const AnyJson& json, const ParameterTable& table) {
  MapPoint map;
  const AnyJson& lp = field(json, "lp");
  map.lp = lp.is_null() ? -std::numeric_limits<double>::infinity() : number(json, "lp");
  const AnyJson& values = field(json, "values");
  for (const Parameter& parameter : table.continuous)
    map.values.continuous.push_back(number(values, parameter.name.c_str()));
  for (const DiscreteParameter& parameter : table.discrete)
    map.values.discrete.push_back(
        integer(values, parameter.name.c_str(), 0, static_cast<int>(parameter.levels.size()) - 1));
  return map;
}

Alarms alarms(const AnyJson& json) {
  Alarms alarms;
  for (const AnyJson& item : list(json, "alarms"))
    alarms.push_back({text(item, "name"), text(item, "sentence")});
  return alarms;
}

std::vector<double> numbers(const AnyJson& json, const char* key) {
  std::vector<double> result;
  for (const AnyJson& item : list(json, key)) {
    if (!item.is_number()) throw BadField{"'" + std::string(key) + "' holds something that is not a number"};
    result.push_back(item.get<double>());
  }
  return result;
}

RunTimes times(const AnyJson& json) {
  return {number(json, "search"), numbers(json, "warmup"), numbers(json, "sampling")};
}

RunPhase phase(const AnyJson& json) {
  const std::string found = text(json, "phase");
  for (const auto& [phase, word] : kPhaseWords)
    if (word == found) return phase;
  throw BadField{"the phase '" + found.substr(0, 40) + "' is unknown"};
}

Manifest manifest(const AnyJson& json) {
  Manifest m;
  m.program = text(json, "program");
  m.settings = settings(field(json, "settings"));
  m.table = table(field(json, "material"));
  m.settings.material = m.table.material;
  const AnyJson& capture = field(json, "capture");
  m.settings.capture = {positive(capture, "size_cm"), positive(capture, "camera_cm")};
  const AnyJson& photo = field(json, "photo");
  m.photo_sha256 = text(photo, "sha256");
  m.photo_width = integer(photo, "width", 0);
  m.photo_height = integer(photo, "height", 0);
  m.photo_warnings = texts(photo, "warnings");
  if (photo.contains("crop")) {
    const AnyJson& crop = photo["crop"];
    m.crop = {integer(crop, "x", 0), integer(crop, "y", 0), integer(crop, "side", 1)};
  }
  m.network_sha256 = text(json, "network_sha256");
  m.gram_sigma = positive(field(json, "error_model"), "gram_sigma");
  m.mean_sigma = positive(field(json, "error_model"), "mean_sigma");
  m.phase = phase(json);
  m.reason = text(json, "reason");
  if (const AnyJson& map = field(json, "map"); !map.is_null()) m.map = map_point(map, m.table);
  if (json.contains("kernel")) m.kernel = text(json, "kernel");
  m.errors = one_of(json, "errors", error_names(), "");
  if (json.contains("warmup")) m.warmup = integer(json, "warmup", 0);
  if (json.contains("so_far")) m.so_far = map_point(json["so_far"], m.table);
  if (json.contains("basins"))
    for (const AnyJson& basin : list(json, "basins")) m.basins.push_back(map_point(basin, m.table));
  if (json.contains("seconds")) m.seconds = times(json["seconds"]);  // runs of the first version have none
  if (json.contains("photo_fit")) m.photo_fit = photo_fit(json["photo_fit"]);
  if (json.contains("alarms")) m.alarms = alarms(json);
  if (json.contains("evidence")) m.evidence = evidence(json["evidence"]);
  return m;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw UserError(file.string() + " is damaged (" + why + "): restore it from a copy, or start a new run.");
}

void refuse_newer(const AnyJson& json, const std::filesystem::path& directory) {
  if (number(json, "format") > kRunFormat)
    throw UserError(directory.string() + " was made by a newer version of the program (run format " +
                    field(json, "format").dump() + ", this one knows " + std::to_string(kRunFormat) +
                    "): open it with that version.");
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& directory) {
  const std::filesystem::path file = manifest_file(directory);
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored))
    throw UserError("There is no run directory " + directory.string() +
                    ": check the path, or make one with 'patina-cli fit'.");
  if (!std::filesystem::exists(file, ignored))
    throw UserError(
        directory.string() +
        " is not a run directory, for it holds no run.json: name one that 'patina-cli fit' made.");
  const AnyJson json = AnyJson::parse(read_file(file), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) refuse(file, "it is not JSON");
  try {
    refuse_newer(json, directory);
    return manifest(json);
  } catch (const BadField& bad) {
    refuse(file, bad.why);
  } catch (const AnyJson::exception& error) {
    refuse(file, error.what());
  }
}

}  // namespace patina
