#include "engine/run/chain_checkpoint.h"

#include <vector>

#include "engine/run/state_file.h"
#include "engine/run/state_fits.h"
#include "engine/sampling/serialise.h"

namespace patina {
namespace {

void serialise(Archive& archive, ChainCsvPlace& place) {
  archive(place.bytes, place.rows_after_warmup, place.adapted);
}

void serialise_checkpoint(Archive& archive, ChainCheckpoint& c) {
  archive(c.iteration, c.random_position, c.window, c.state, c.warmup, c.frozen);
  serialise(archive, c.file);
  archive(c.warmup_seconds, c.sampling_seconds);
}

/// Whether a chain in that window can have made so many transitions.
bool fits(const ChainCheckpoint& c, const std::vector<WarmupWindow>& schedule, int warmup) {
  if (c.window < 0 || c.window > std::ssize(schedule) || c.iteration < 0) return false;
  if (c.window == std::ssize(schedule)) return c.iteration >= warmup;
  const WarmupWindow& window = schedule[static_cast<std::size_t>(c.window)];
  return c.iteration >= window.begin && c.iteration <= window.end;
}

void check(const ChainCheckpoint& c, const LogDensity& target, int warmup) {
  const std::vector<WarmupWindow> schedule = warmup_schedule(warmup);
  if (!fits(c, schedule, warmup)) throw ArchiveError("it is at no place of a warm-up");
  if (!fits(c.state, target)) throw ArchiveError("its point is not one of this posterior");
  const bool adapts = c.window < std::ssize(schedule);
  if (!fits(adapts ? c.warmup.settings() : c.frozen, target))
    throw ArchiveError("its metric is not one of this posterior");
  if (adapts && !c.warmup.has_dimension(target.dimension()))
    throw ArchiveError("its warm-up is not one of this posterior");
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const std::string& run_key,
                      ChainCheckpoint& checkpoint) {
  Archive archive;
  serialise_checkpoint(archive, checkpoint);
  write_state(file, run_key, archive.take_bytes());
}

std::optional<ChainCheckpoint> read_checkpoint(const std::filesystem::path& file, const std::string& run_key,
                                               const LogDensity& target, int warmup) {
  const std::optional<std::string> payload = read_state(file, run_key);
  if (!payload) return std::nullopt;
  try {
    Archive archive(*payload);
    ChainCheckpoint checkpoint;
    serialise_checkpoint(archive, checkpoint);
    archive.expect_end();
    check(checkpoint, target, warmup);
    return checkpoint;
  } catch (const ArchiveError& error) {
    refuse_state(file, error.what());
  }
}

}  // namespace patina
