#include "engine/run/state_file.h"

#include <array>
#include <vector>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

constexpr std::string_view kMagic = "patina-state";

std::string first_line_of(const std::string& run_key, std::string_view payload) {
  return std::string(kMagic) + " " + std::to_string(kStateFormat) + " " + run_key + " " +
         sha256_hex(payload) + "\n";
}

/// The first word of a text, which is cut off it together with one blank.
std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(text.size(), word.size() + 1));
  return word;
}

/// @throws UserError
std::string payload_of(const std::filesystem::path& file, const std::string& run_key) {
  std::string contents = read_file(file);
  const std::size_t end = contents.find('\n');
  std::string_view line = std::string_view(contents).substr(0, end);
  if (end == std::string::npos || take_word(line) != kMagic) refuse_state(file, "it is not a state file");
  if (take_word(line) != std::to_string(kStateFormat))
    refuse_state(file, "another version of the program wrote it");
  if (take_word(line) != run_key) refuse_state(file, "it belongs to another run");
  std::string payload = contents.substr(end + 1);
  if (line != sha256_hex(payload)) refuse_state(file, "its checksum is wrong");
  return payload;
}

}  // namespace

std::filesystem::path mode_state_file(const std::filesystem::path& directory) {
  return directory / "mode.state";
}

std::filesystem::path warmup_state_file(const std::filesystem::path& directory) {
  return directory / "warmup.state";
}

std::filesystem::path chain_state_file(const std::filesystem::path& directory, int chain) {
  return directory / ("chain-" + std::to_string(chain + 1) + ".state");
}

void write_state(const std::filesystem::path& file, const std::string& run_key, std::string_view payload) {
  write_file_atomically(file, first_line_of(run_key, payload).append(payload));
}

bool read_state(const std::filesystem::path& file, const std::string& run_key,
                const std::function<void(Archive&)>& unpack) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return false;
  try {
    Archive archive(payload_of(file, run_key));
    unpack(archive);
    archive.expect_end();
  } catch (const ArchiveError& error) {
    refuse_state(file, error.what());
  }
  return true;
}

void refuse_state(const std::filesystem::path& file, const std::string& why) {
  throw UserError(file.string() + " cannot be used (" + why +
                  "): restore it from a copy, or delete it to have the same computed anew.");
}

}  // namespace patina
