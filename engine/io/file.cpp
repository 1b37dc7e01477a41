#include "engine/io/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "engine/error.h"

namespace patina {
namespace {

/// A POSIX file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse_write(file, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

[[noreturn]] void refuse_size(const std::filesystem::path& file, std::size_t limit_bytes) {
  throw UserError(file.string() + " has more than " + std::to_string(limit_bytes) +
                  " bytes, which is more than a file of its kind can need: check that it is the right one.");
}

}  // namespace

void refuse_write(const std::filesystem::path& file, int error) {
  if (error == ENOSPC || error == EDQUOT || error == EFBIG)
    throw UserError("The disk is full: " + file.string() +
                    " could not be written, so make room and try again.");
  throw UserError("Cannot write " + file.string() + " (" + std::strerror(error) + "): choose another place.");
}

std::string read_file(const std::filesystem::path& file, std::size_t limit_bytes) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.get() < 0)
    throw UserError("Cannot open " + file.string() + " (" + std::strerror(errno) +
                    "): check the path and its permissions.");
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0 || !S_ISREG(status.st_mode))
    throw UserError(file.string() + " is not a file: name one.");
  if (static_cast<std::size_t>(status.st_size) > limit_bytes) refuse_size(file, limit_bytes);
  std::string contents;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor.get(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw UserError("Cannot read " + file.string() + " (" + std::strerror(errno) + "): try a copy of it.");
    if (count == 0) return contents;
    contents.append(buffer.data(), static_cast<std::size_t>(count));
    if (contents.size() > limit_bytes) refuse_size(file, limit_bytes);  // it grew since fstat
  }
}

void write_file_atomically(const std::filesystem::path& file, std::string_view contents) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  try {
    const Descriptor descriptor(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (descriptor.get() < 0) refuse_write(file, errno);
    write_all(descriptor.get(), contents, file);
    if (::fsync(descriptor.get()) != 0 && errno != EINVAL) refuse_write(file, errno);
    if (::rename(temporary.c_str(), file.c_str()) != 0) refuse_write(file, errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available in this libcrypto");
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (unsigned i = 0; i < length; ++i) {
    hex += kDigits[digest[i] >> 4];
    hex += kDigits[digest[i] & 15];
  }
  return hex;
}

std::filesystem::path data_directory() {
  if (const char* chosen = std::getenv("PATINA_DATA"); chosen && *chosen) return chosen;
  std::error_code ignored;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return executable.parent_path().parent_path() / "share" / "patina";
}

}  // namespace patina
