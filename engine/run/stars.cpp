#include "engine/run/stars.h"

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

std::filesystem::path stars_file(const std::filesystem::path& directory) { return directory / "stars.json"; }

std::vector<Star> parse(const Json& json) {
  std::vector<Star> stars;
  for (const Json& entry : json.at("stars")) {
    const Star star{entry.at("chain").get<int>() - 1, entry.at("iteration").get<std::int64_t>(),
                    entry.at("note").get<std::string>()};
    if (star.chain < 0 || star.iteration < 0) throw UserError("a place that no draw has");
    stars.push_back(star);
  }
  return stars;
}

/// Sets a file aside that cannot be read, so that it is not lost where a new one is written.
void keep_damaged(const std::filesystem::path& directory) {
  try {
    read_stars(directory);
  } catch (const UserError&) {
    std::error_code ignored;
    std::filesystem::rename(stars_file(directory), stars_file(directory).string() + ".damaged", ignored);
  }
}

}  // namespace

std::vector<Star> read_stars(const std::filesystem::path& directory) {
  const auto file = stars_file(directory);
  if (!std::filesystem::exists(file)) return {};
  const std::string text = read_file(file);
  int format = 0;
  try {
    const Json json = Json::parse(text);
    format = json.at("format").get<int>();
    if (format == kFormat) return parse(json);
  } catch (const std::exception&) {
    throw UserError("The stars in " + file.string() +
                    " cannot be read, for the file is damaged: restore it from a copy, or delete it.");
  }
  throw UserError("The stars in " + file.string() + " were written by another version of Patina (format " +
                  std::to_string(format) + "): open the run with that version.");
}

void write_stars(const std::filesystem::path& directory, const std::vector<Star>& stars) {
  keep_damaged(directory);
  Json entries = Json::array();
  for (const Star& star : stars)
    entries.push_back({{"chain", star.chain + 1}, {"iteration", star.iteration}, {"note", star.note}});
  // A note may hold bytes that are no UTF-8, pasted from elsewhere.
  const Json json{{"format", kFormat}, {"stars", entries}};
  write_file_atomically(stars_file(directory),
                        json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace patina
