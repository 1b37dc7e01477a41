#include "engine/run/run.h"

#include <utility>

#include "engine/run/run_files.h"
#include "engine/run/run_photo.h"
#include "engine/run/run_reader.h"
#include "engine/run/sampler_run.h"

namespace patina {

std::unique_ptr<DrawSource> start_run(const RunSettings& settings, const Photo& photo,
                                      const std::filesystem::path& directory, std::function<void()> wake) {
  return std::make_unique<SamplerRun>(settings, photo, directory, std::move(wake), Opening::fresh);
}

std::unique_ptr<DrawSource> resume_run(const RunSettings& settings, const Photo& photo,
                                       const std::filesystem::path& directory, std::function<void()> wake) {
  std::error_code ignored;
  const bool there = std::filesystem::exists(manifest_file(directory), ignored);
  return std::make_unique<SamplerRun>(settings, photo, directory, std::move(wake),
                                      there ? Opening::resumed : Opening::fresh);
}

std::unique_ptr<DrawSource> resume_run(const RunSettings& settings, const std::filesystem::path& directory,
                                       std::function<void()> wake) {
  return std::make_unique<SamplerRun>(settings, photo_of_run(directory), directory, std::move(wake),
                                      Opening::resumed);
}

std::unique_ptr<DrawSource> open_run(const std::filesystem::path& directory, std::size_t portion) {
  return std::make_unique<RunReader>(directory, portion);
}

}  // namespace patina
