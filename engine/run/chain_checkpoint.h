#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/io/chain_csv.h"
#include "engine/run/run_settings.h"
#include "engine/sampling/climber.h"

namespace patina {

/// One chain between two transitions: all that its future draws depend on, beside the run's settings.
struct ChainCheckpoint {
  std::int64_t iteration = 0;         ///< transitions made, warm-up included
  std::uint64_t random_position = 0;  ///< of its random stream: Rng::position()
  int window = 0;                     ///< of warmup_schedule(); their number once warm-up is over
  Climber climber;
  ChainCsvPlace file;
  double warmup_seconds = 0, sampling_seconds = 0;  ///< spent so far
};

/// Writes chain-K.state. @param run_key  see state_file.h @throws UserError
void write_checkpoint(const std::filesystem::path& file, const std::string& run_key,
                      ChainCheckpoint& checkpoint);

/// Nothing if there is no such file.
/// @throws UserError for a file that cannot be one of a chain of those settings on that target
std::optional<ChainCheckpoint> read_checkpoint(const std::filesystem::path& file, const std::string& run_key,
                                               const LogDensity& target, const RunSettings& settings);

}  // namespace patina
