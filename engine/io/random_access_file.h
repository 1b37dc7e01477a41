#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace patina {

/// A large file of which only parts are wanted, open for reading. Safe to read from several threads.
class RandomAccessFile {
 public:
  /// @throws UserError unless it is a readable regular file of at most limit_bytes
  RandomAccessFile(const std::filesystem::path& file, std::uint64_t limit_bytes);
  ~RandomAccessFile();
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// @throws UserError if the file cannot be read or has become shorter than begin + bytes
  void read(std::uint64_t begin, std::size_t bytes, void* to) const;
  std::string read(std::uint64_t begin, std::size_t bytes) const;

  /// SHA-256 of the whole file, hexadecimal.
  std::string sha256_hex() const;

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace patina
