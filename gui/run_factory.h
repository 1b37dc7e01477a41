#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "engine/run/run.h"
#include "gui/background_source.h"
#include "gui/material_finder.h"

namespace patina {

/// start_run() and resume_run() on threads that leave the cores to the window.
std::unique_ptr<DrawSource> start_behind_frames(const RunSettings& settings, const Photo& photo,
                                                const std::filesystem::path& directory,
                                                std::function<void()> wake);
std::unique_ptr<DrawSource> resume_behind_frames(const RunSettings& settings,
                                                 const std::filesystem::path& directory,
                                                 std::function<void()> wake);

/// Where the window gets its runs from. Tests put runs of known draws here.
struct RunFactory {
  std::function<std::unique_ptr<DrawSource>(
      const RunSettings&, const Photo&, const std::filesystem::path& directory, std::function<void()> wake)>
      start = start_behind_frames;
  std::function<std::unique_ptr<DrawSource>(const RunSettings&, const std::filesystem::path& directory,
                                            std::function<void()> wake)>
      resume = resume_behind_frames;
  std::function<std::unique_ptr<DrawSource>(const std::filesystem::path& directory,
                                            std::function<void()> wake)>
      open = open_in_background;
  MaterialFinder::Rank rank = rank_materials;
};

/// Where runs started in the window are kept: $XDG_DATA_HOME/patina/runs, or ~/.local/share/patina/runs.
/// Without either a folder for temporary files, so that a run can start at all.
std::filesystem::path default_runs_directory();

/// A directory that does not exist yet: runs/<photo>-<material>-<date>-<time>, with -2, -3 ... if it is
/// taken.
std::filesystem::path fresh_run_directory(const std::filesystem::path& runs, const std::string& photo_name,
                                          const std::string& material);

/// The photo's name in the name of such a directory; of another directory all of its name.
std::string photo_name_of(const std::filesystem::path& run_directory);

}  // namespace patina
