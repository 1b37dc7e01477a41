#include "engine/run/mode_state.h"

#include "engine/error.h"
#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "engine/run/state_fits.h"
#include "engine/sampling/serialise.h"

namespace patina {
namespace {

/// What the settings make optional is there or not with them; an emulator is not before there are chains.
void serialise(Archive& archive, ModeFound& found, const RunSettings& settings) {
  archive(found.mode, found.laplace);
  if (settings.errors == "calibrated") {
    if (!found.errors) found.errors.emplace();
    archive(*found.errors);
  }
  const bool may_average = settings.errors == "averaged" || settings.errors == kAuto;
  if (may_average) archive(found.wider);
  if (settings.kernel != kEmulated && settings.kernel != kAuto) return;
  archive(found.has_tried_to_emulate);
  archive(found.emulator);
  if (may_average) archive(found.average);
  archive(found.has_learnt_again);
}

}  // namespace

void write_mode(const std::filesystem::path& directory, const std::string& run_key, ModeFound found,
                const RunSettings& settings) {
  Archive archive;
  serialise(archive, found, settings);
  write_state(mode_state_file(directory), run_key, archive.take_bytes());
}

std::optional<ModeFound> read_mode(const std::filesystem::path& directory, const std::string& run_key,
                                   const Posterior& target, const RunSettings& settings) {
  ModeFound found;
  const bool is_there = read_state(mode_state_file(directory), run_key, [&](Archive& archive) {
    serialise(archive, found, settings);
    if (!fits(found.laplace, target) || !fits(found.mode, target) ||
        (found.errors && !fits(*found.errors, target)) ||
        (found.wider && !found.wider->are_of(target.photo_summary().size())) ||
        (found.emulator && !found.emulator->is_of(std::ssize(target.informed()))) ||
        (found.average && !found.average->is_of(target.dimension(), std::ssize(target.informed()))))
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
