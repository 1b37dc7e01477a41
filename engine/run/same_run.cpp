#include "engine/run/same_run.h"

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

using SortedJson = nlohmann::json;

/// What decides the draws, as a flat object: {"/settings/kernel": "hmc", ...}.
SortedJson identity(const Manifest& manifest) {
  SortedJson json = SortedJson::parse(to_json(manifest));
  for (const char* progress : {"phase", "reason", "map", "so_far", "kernel", "errors", "warmup", "basins",
                               "seconds", "evidence", "photo_fit"})
    json.erase(progress);
  json["photo"].erase("warnings");
  json["alarms"] = SortedJson::array();
  for (const char* free : {"draws", "map_only", "stop"}) json["settings"].erase(free);
  // As before there were others.
  if (json["settings"]["errors"] == "paper") json["settings"].erase("errors");
  if (json["settings"]["precision"] == "float32") json["settings"].erase("precision");
  if (json["settings"]["device"] == "cpu") json["settings"].erase("device");
  json["settings"].erase("network");  // its checksum counts, not where it lies
  return json.flatten();
}

std::string value_in(const SortedJson& flat, const std::string& key) {
  return flat.contains(key) ? flat[key].dump() : "not set";
}

}  // namespace

std::string run_key(const Manifest& manifest) { return sha256_hex(identity(manifest).dump()); }

void check_same_run(const std::filesystem::path& directory, const Manifest& made, const Manifest& asked) {
  const SortedJson before = identity(made), now = identity(asked);
  SortedJson keys = before;
  keys.update(now);
  for (const auto& [key, ignored] : keys.items()) {
    const std::string there = value_in(before, key), here = value_in(now, key);
    if (there != here)
      throw UserError("The run in " + directory.string() + " has another " + key.substr(1) + " (" + there +
                      ", not " + here + "): go on with it as it was made, or start a new run.");
  }
  if (asked.settings.draws < made.settings.draws)
    throw UserError("The run in " + directory.string() + " was asked for " +
                    std::to_string(made.settings.draws) + " draws a chain: ask for as many or more.");
}

}  // namespace patina
