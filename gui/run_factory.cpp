#include "gui/run_factory.h"

#include <array>
#include <cstdlib>
#include <ctime>
#include <regex>
#include <utility>

#include "gui/priority.h"

namespace patina {
namespace {

std::string timestamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &local);
  return text.data();
}

}  // namespace

std::unique_ptr<DrawSource> start_behind_frames(const RunSettings& settings, const Photo& photo,
                                                const std::filesystem::path& directory,
                                                std::function<void()> wake) {
  return behind_frames([&] { return start_run(settings, photo, directory, std::move(wake)); });
}

std::unique_ptr<DrawSource> resume_behind_frames(const RunSettings& settings,
                                                 const std::filesystem::path& directory,
                                                 std::function<void()> wake) {
  return behind_frames([&] { return resume_run(settings, directory, std::move(wake)); });
}

std::filesystem::path default_runs_directory() {
  const std::filesystem::path below = std::filesystem::path("patina") / "runs";
  if (const char* data_home = std::getenv("XDG_DATA_HOME"); data_home != nullptr && *data_home == '/')
    return data_home / below;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".local" / "share" / below;
  }
  std::error_code ignored;
  return std::filesystem::temp_directory_path(ignored) / below;
}

std::filesystem::path fresh_run_directory(const std::filesystem::path& runs, const std::string& photo_name,
                                          const std::string& material) {
  const std::string name = photo_name + "-" + material + "-" + timestamp();
  std::filesystem::path directory = runs / name;
  for (int copy = 2; std::filesystem::exists(directory); ++copy)
    directory = runs / (name + "-" + std::to_string(copy));
  return directory;
}

std::string photo_name_of(const std::filesystem::path& run_directory) {
  static const std::regex made_here("(.+)-[a-z_]+-[0-9]{8}-[0-9]{6}(-[0-9]+)?");
  const std::string name = run_directory.filename().string();
  std::smatch parts;
  return std::regex_match(name, parts, made_here) ? parts[1].str() : name;
}

}  // namespace patina
