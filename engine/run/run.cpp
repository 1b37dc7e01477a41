#include "engine/run/run.h"

#include <utility>

#include "engine/run/run_reader.h"
#include "engine/run/sampler_run.h"

namespace patina {

std::unique_ptr<DrawSource> start_run(const RunSettings& settings, const Photo& photo,
                                      const std::filesystem::path& directory, std::function<void()> wake) {
  return std::make_unique<SamplerRun>(settings, photo, directory, std::move(wake));
}

std::unique_ptr<DrawSource> open_run(const std::filesystem::path& directory) {
  return std::make_unique<RunReader>(directory);
}

}  // namespace patina
