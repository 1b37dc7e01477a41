#include "gui/window/preferences.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A number in a range, or what it was.
template <typename Number>
void take(const Json& json, const char* key, Number low, Number high, Number& value) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_number()) return;
  const double found = json[key].get<double>();
  if (found >= static_cast<double>(low) && found <= static_cast<double>(high))
    value = static_cast<Number>(found);
}

void take(const Json& json, const char* key, fs::path& value) {
  if (json.contains(key) && json[key].is_string()) value = json[key].get<std::string>();
}

void take_recent(const Json& json, Preferences& preferences) {
  if (!json.contains("recent") || !json["recent"].is_array()) return;
  for (const Json& file : json["recent"])
    if (file.is_string() && preferences.recent.size() < Preferences::kMostRecent)
      preferences.recent.emplace_back(file.get<std::string>());
}

void take_draw(const Json& json, Preferences& preferences) {
  if (!json.contains("draw") || !json["draw"].is_object()) return;
  DrawPlace place{-1, -1};
  take(json["draw"], "chain", 0, 10'000, place.chain);
  take<std::int64_t>(json["draw"], "iteration", 0, 1'000'000'000'000, place.iteration);
  if (place.chain >= 0 && place.iteration >= 0) preferences.draw = place;
}

}  // namespace

void Preferences::opened(const fs::path& file) {
  std::erase(recent, file);
  recent.insert(recent.begin(), file);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

fs::path preferences_file() {
  const fs::path below = fs::path("patina") / "settings.json";
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config != nullptr && *config == '/')
    return config / below;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".config" / below;
  return {};
}

Preferences read_preferences(const fs::path& file) {
  Preferences preferences;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return preferences;
  const Json json = Json::parse(read_file(file), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object())
    throw UserError("The settings in " + file.string() + " cannot be read; Patina begins without them.");
  take_recent(json, preferences);
  take(json, "last_folder", preferences.last_folder);
  take(json, "last_run", preferences.last_run);
  take_draw(json, preferences);
  take(json, "width", 320, 16384, preferences.width);
  take(json, "height", 240, 16384, preferences.height);
  take(json, "left_column", 0.18f, 0.40f, preferences.shares.left);
  take(json, "right_column", 0.18f, 0.40f, preferences.shares.right);
  take(json, "scale", Preferences::kLeastScale, Preferences::kMostScale, preferences.scale);
  preferences.light_theme = json.contains("theme") && json["theme"] == "light";
  return preferences;
}

void write_preferences(const fs::path& file, const Preferences& preferences) {
  Json json = {{"recent", Json::array()},
               {"last_folder", preferences.last_folder.string()},
               {"last_run", preferences.last_run.string()},
               {"width", preferences.width},
               {"height", preferences.height},
               {"left_column", preferences.shares.left},
               {"right_column", preferences.shares.right},
               {"scale", preferences.scale},
               {"theme", preferences.light_theme ? "light" : "dark"}};
  for (const fs::path& recent : preferences.recent) json["recent"].push_back(recent.string());
  if (preferences.draw)
    json["draw"] = {{"chain", preferences.draw->chain}, {"iteration", preferences.draw->iteration}};
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  // A path need not be UTF-8; the file must be.
  write_file_atomically(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace patina
