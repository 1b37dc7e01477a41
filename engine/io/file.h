#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

/// The whole of a small file. @throws UserError if it cannot be read or is larger than limit_bytes
std::string read_file(const std::filesystem::path& file, std::size_t limit_bytes = 64u << 20);

/// Writes a temporary file beside it, flushes it to disk and renames it. @throws UserError (says "disk is
/// full" where that is why)
void write_file_atomically(const std::filesystem::path& file, std::string_view contents);

/// Throws the UserError for a failed write: says "disk is full" where that is why. @param error  errno
[[noreturn]] void refuse_write(const std::filesystem::path& file, int error);

/// SHA-256, hexadecimal.
std::string sha256_hex(std::string_view bytes);

/// The program's data: materials/, networks/, photos/, shaders/. $PATINA_DATA, or share/patina beside the
/// bin/ of this executable.
std::filesystem::path data_directory();

}  // namespace patina
