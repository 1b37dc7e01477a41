#include "engine/io/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {

AppendFile::AppendFile(const std::filesystem::path& file)
    : file_(file), descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) refuse_write(file_, errno);
}

AppendFile::AppendFile(const std::filesystem::path& file, std::int64_t size)
    : file_(file), descriptor_(::open(file.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) refuse_write(file_, errno);
  try {
    cut_to(size);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

AppendFile::~AppendFile() { ::close(descriptor_); }

void AppendFile::append(std::string_view piece) {
  std::int64_t end = size_;
  while (!piece.empty()) {
    const ssize_t written = ::pwrite(descriptor_, piece.data(), piece.size(), end);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      [[maybe_unused]] const int cut = ::ftruncate(descriptor_, size_);
      refuse_write(file_, error);
    }
    end += written;
    piece.remove_prefix(static_cast<std::size_t>(written));
  }
  size_ = end;
}

void AppendFile::patch(std::int64_t offset, std::string_view piece) {
  assert(offset >= 0 && offset + static_cast<std::int64_t>(piece.size()) <= size_);
  if (::pwrite(descriptor_, piece.data(), piece.size(), offset) != static_cast<ssize_t>(piece.size()))
    refuse_write(file_, errno);
}

void AppendFile::sync() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) refuse_write(file_, errno);
}

void AppendFile::cut_to(std::int64_t size) {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) refuse_write(file_, errno);
  if (status.st_size < size)
    throw UserError(file_.string() + " is shorter than it was: restore it from a copy, or start a new run.");
  if (::ftruncate(descriptor_, size) != 0) refuse_write(file_, errno);
  size_ = size;
}

}  // namespace patina
