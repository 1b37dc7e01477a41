#include "engine/run/mode_state.h"

#include "engine/error.h"
#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "engine/run/state_fits.h"
#include "engine/sampling/serialise.h"

namespace patina {

void write_mode(const std::filesystem::path& directory, const std::string& run_key, ModeFound found) {
  Archive archive;
  archive(found.mode, found.laplace);
  if (found.errors) archive(*found.errors);
  write_state(mode_state_file(directory), run_key, archive.take_bytes());
}

std::optional<ModeFound> read_mode(const std::filesystem::path& directory, const std::string& run_key,
                                   const Posterior& target, bool calibrated) {
  ModeFound found;
  const bool is_there = read_state(mode_state_file(directory), run_key, [&](Archive& archive) {
    archive(found.mode, found.laplace);
    if (calibrated) archive(found.errors.emplace());
    if (!fits(found.laplace, target) || !fits(found.mode, target) ||
        (calibrated && !fits(*found.errors, target)))
      throw ArchiveError("it is of another posterior");
  });
  if (!is_there) return std::nullopt;
  return found;
}

void check_has_mode(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (std::filesystem::exists(mode_state_file(directory), ignored)) return;
  if (std::filesystem::exists(chain_file(directory, 0), ignored) ||
      std::filesystem::exists(chain_state_file(directory, 0), ignored))
    throw UserError(
        "The run in " + directory.string() +
        " has draws but no mode.state to go on from: restore it from a copy, or start a new run.");
}

}  // namespace patina
