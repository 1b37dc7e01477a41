#include "engine/run/run_state.h"

#include <vector>

#include "engine/error.h"
#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "engine/run/state_fits.h"
#include "engine/sampling/serialise.h"

namespace patina {
namespace {

struct Agreement {
  int window = 0;
  LadderSettings settings;
  void serialise(Archive& archive) { archive(window, settings); }
};

template <typename T>
std::string bytes_of(T& value) {
  Archive archive;
  archive(value);
  return archive.take_bytes();
}

/// Reads and checks; every reason against it becomes the same sentence.
template <typename Read>
void read_checked(const std::filesystem::path& file, const std::string& payload, Read read) {
  try {
    Archive archive(payload);
    read(archive);
    archive.expect_end();
  } catch (const ArchiveError& error) {
    refuse_state(file, error.what());
  }
}

}  // namespace

void write_mode(const std::filesystem::path& directory, const std::string& run_key, ModeFound found) {
  Archive archive;
  archive(found.mode, found.laplace);
  if (found.errors) archive(*found.errors);
  write_state(mode_state_file(directory), run_key, archive.take_bytes());
}

std::optional<ModeFound> read_mode(const std::filesystem::path& directory, const std::string& run_key,
                                   const Posterior& target, bool calibrated) {
  const std::filesystem::path file = mode_state_file(directory);
  const auto payload = read_state(file, run_key);
  if (!payload) return std::nullopt;
  ModeFound found;
  read_checked(file, *payload, [&](Archive& archive) {
    archive(found.mode, found.laplace);
    if (calibrated) archive(found.errors.emplace());
    if (!fits(found.laplace, target) || !fits(found.mode, target) ||
        (calibrated && !fits(*found.errors, target)))
      throw ArchiveError("it is of another posterior");
  });
  return found;
}

void check_has_states(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (std::filesystem::exists(mode_state_file(directory), ignored)) return;
  if (std::filesystem::exists(chain_file(directory, 0), ignored) ||
      std::filesystem::exists(chain_state_file(directory, 0), ignored))
    throw UserError(
        "The run in " + directory.string() +
        " has draws but no mode.state to go on from: restore it from a copy, or start a new run.");
}

void write_warmup(const std::filesystem::path& directory, const std::string& run_key, WarmupRecord record) {
  std::vector<Agreement> agreements;
  for (const auto& [window, settings] : record) agreements.push_back({window, settings});
  write_state(warmup_state_file(directory), run_key, bytes_of(agreements));
}

WarmupRecord read_warmup(const std::filesystem::path& directory, const std::string& run_key,
                         const LogDensity& target, int rungs) {
  const std::filesystem::path file = warmup_state_file(directory);
  const auto payload = read_state(file, run_key);
  WarmupRecord record;
  if (!payload) return record;
  read_checked(file, *payload, [&](Archive& archive) {
    std::vector<Agreement> agreements;
    archive(agreements);
    for (const Agreement& agreement : agreements) {
      if (!fits(agreement.settings, target, rungs)) throw ArchiveError("it is of another posterior");
      record[agreement.window] = agreement.settings;
    }
  });
  return record;
}

}  // namespace patina
