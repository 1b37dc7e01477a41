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
  archive(c.iteration, c.random_position, c.window, c.climber);
  serialise(archive, c.file);
  archive(c.warmup_seconds, c.sampling_seconds);
}

/// Whether a chain in that window can have made so many transitions.
bool is_in_its_window(const ChainCheckpoint& c, const std::vector<WarmupWindow>& schedule, int warmup) {
  if (c.window < 0 || c.window > std::ssize(schedule) || c.iteration < 0) return false;
  if (c.window == std::ssize(schedule)) return c.iteration >= warmup;
  const WarmupWindow& window = schedule[static_cast<std::size_t>(c.window)];
  return c.iteration >= window.begin && c.iteration <= window.end;
}

void check(const ChainCheckpoint& c, const LogDensity& target, const RunSettings& settings) {
  if (!is_in_its_window(c, warmup_schedule(settings.warmup.value()), settings.warmup.value()))
    throw ArchiveError("it is at no place of a warm-up");
  if (!fits(c.climber.betas, settings.rungs())) throw ArchiveError("its ladder is not one of this run");
  if (!fits(c.climber.state, target, settings.rungs()))
    throw ArchiveError("its point is not one of this posterior");
  if (!fits(c.climber.warmups, target, settings.rungs()) || c.climber.swaps.rungs() != c.climber.betas.size())
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
                                               const LogDensity& target, const RunSettings& settings) {
  ChainCheckpoint checkpoint;
  const bool is_there = read_state(file, run_key, [&](Archive& archive) {
    serialise_checkpoint(archive, checkpoint);
    check(checkpoint, target, settings);
  });
  if (!is_there) return std::nullopt;
  return checkpoint;
}

}  // namespace patina
