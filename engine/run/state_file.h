#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace patina {

class Archive;

// The sampler's state in a run directory, from which a run that was stopped or killed goes on to the very
// same draws:
//   mode.state      the mode and Laplace's covariance there: what the search handed to the chains
//   warmup.state    what the chains agreed on at the end of each window of warm-up
//   chain-K.state   one chain between two transitions, renewed every few seconds
// Numbers as this machine keeps them: the same draws are promised on the same machine only.

std::filesystem::path mode_state_file(const std::filesystem::path& directory);
std::filesystem::path warmup_state_file(const std::filesystem::path& directory);
std::filesystem::path chain_state_file(const std::filesystem::path& directory, int chain);

constexpr int kStateFormat = 7;  ///< grows with every change of what is serialised

/// Writes one line (format, what run it belongs to, SHA-256) and the payload, atomically.
/// @param run_key  without blanks; see run_key()  @throws UserError
void write_state(const std::filesystem::path& file, const std::string& run_key, std::string_view payload);

/// Hands the payload of a state file to `unpack`, which may throw ArchiveError where it does not fit; false
/// if there is no such file.
/// @throws UserError for a file that is damaged, of another format, or belongs to another run, and in place
/// of
///         ArchiveError
bool read_state(const std::filesystem::path& file, const std::string& run_key,
                const std::function<void(Archive&)>& unpack);

/// Throws the UserError for a state file that cannot be used. @param why  a clause
[[noreturn]] void refuse_state(const std::filesystem::path& file, const std::string& why);

}  // namespace patina
