#pragma once

#include <filesystem>
#include <string>

namespace patina {

/// SHA-256 of the weights file that a run's settings mean, hexadecimal. @param network  empty: the bundled
/// one
/// @throws UserError if it cannot be read
std::string network_checksum(const std::filesystem::path& network);

}  // namespace patina
