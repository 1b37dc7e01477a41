#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace patina {

/// A file that only grows, by whole pieces: each append is handed to the operating system at once, so that
/// killing the process loses nothing that append() returned from. One thread at a time.
class AppendFile {
 public:
  /// Creates an empty file. @throws UserError if it cannot be created
  explicit AppendFile(const std::filesystem::path& file);
  /// Goes on with a file that is there, cut to its first `size` bytes.
  /// @throws UserError if it cannot be opened or is shorter
  AppendFile(const std::filesystem::path& file, std::int64_t size);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// All or nothing: on failure the file is cut back to its former end, so that the same piece can be tried
  /// again later. @throws UserError ("The disk is full ..." where that is why)
  void append(std::string_view piece);

  /// Overwrites bytes written before, without moving the end. @throws UserError
  void patch(std::int64_t offset, std::string_view piece);

  /// Waits until all of it is on the disk, safe from a loss of power as well. @throws UserError
  void sync();

  std::int64_t size() const { return size_; }

 private:
  void cut_to(std::int64_t size);

  std::filesystem::path file_;
  int descriptor_;
  std::int64_t size_ = 0;
};

}  // namespace patina
