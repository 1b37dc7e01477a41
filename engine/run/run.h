#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>

#include "engine/io/photo.h"
#include "engine/run/draw_source.h"

namespace patina {

/// Starts sampling on threads of its own and writes the run directory. Destroying it stops the chains within
/// one evaluation and joins; what was drawn is on disk.
/// @param wake   called from sampler threads when there is something new to show; may be empty
/// @throws UserError before anything is started: unknown names, impossible settings, a directory that holds a
///         run already or cannot be written
std::unique_ptr<DrawSource> start_run(const RunSettings& settings, const Photo& photo,
                                      const std::filesystem::path& directory,
                                      std::function<void()> wake = {});

/// Goes on with the run in a directory, from where it was stopped, killed, or finished with fewer draws, to
/// the chain files that it would have made undisturbed, byte for byte (on the same machine). The draws that
/// it has come first. Where there is no run it starts one.
/// @param settings  those that the run was made with, but for `draws` (as many or more) and `map_only`
/// @param photo     the photo that it was made with
/// @throws UserError as start_run() does, and for a directory of another run, or of a damaged one
std::unique_ptr<DrawSource> resume_run(const RunSettings& settings, const Photo& photo,
                                       const std::filesystem::path& directory,
                                       std::function<void()> wake = {});

/// Likewise, with the photo that the directory keeps. @throws UserError also where there is no run
std::unique_ptr<DrawSource> resume_run(const RunSettings& settings, const std::filesystem::path& directory,
                                       std::function<void()> wake = {});

/// Opens a run directory to read, also one that is still being written: take_draws() yields new whole lines.
/// @param portion  about so many draws at a time, so that someone who waits sees them come
/// @throws UserError for a directory that is empty, half written beyond use, or made by a newer version
std::unique_ptr<DrawSource> open_run(const std::filesystem::path& directory,
                                     std::size_t portion = std::numeric_limits<std::size_t>::max());

}  // namespace patina
