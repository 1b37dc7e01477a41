#include "engine/io/random_access_file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "engine/error.h"

namespace patina {

RandomAccessFile::RandomAccessFile(const std::filesystem::path& file, std::uint64_t limit_bytes)
    : path_(file), descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0)
    throw UserError("Cannot open " + file.string() + " (" + std::strerror(errno) +
                    "): check the path and its permissions.");
  struct stat status {};
  const bool regular = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (regular && size_ <= limit_bytes) return;
  ::close(descriptor_);
  if (!regular) throw UserError(file.string() + " is not a file: name one.");
  throw UserError(file.string() + " has more than " + std::to_string(limit_bytes) +
                  " bytes, which is more than a file of its kind can need: check that it is the right one.");
}

RandomAccessFile::~RandomAccessFile() { ::close(descriptor_); }

void RandomAccessFile::read(std::uint64_t begin, std::size_t bytes, void* to) const {
  auto* next = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t count = ::pread(descriptor_, next, bytes, static_cast<off_t>(begin));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw UserError("Cannot read " + path_.string() + " (" +
                      (count < 0 ? std::strerror(errno) : "it ends too early") + "): try a copy of it.");
    next += count;
    begin += static_cast<std::uint64_t>(count);
    bytes -= static_cast<std::size_t>(count);
  }
}

std::string RandomAccessFile::read(std::uint64_t begin, std::size_t bytes) const {
  std::string contents(bytes, '\0');
  read(begin, bytes, contents.data());
  return contents;
}

std::string RandomAccessFile::sha256_hex() const {
  constexpr std::size_t kPiece = 1 << 20;
  const std::unique_ptr<EVP_MD_CTX, decltype(&::EVP_MD_CTX_free)> context(::EVP_MD_CTX_new(),
                                                                          ::EVP_MD_CTX_free);
  ::EVP_DigestInit_ex(context.get(), ::EVP_sha256(), nullptr);
  std::string piece;
  for (std::uint64_t begin = 0; begin < size_; begin += piece.size()) {
    piece = read(begin, static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, size_ - begin)));
    ::EVP_DigestUpdate(context.get(), piece.data(), piece.size());
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  ::EVP_DigestFinal_ex(context.get(), digest.data(), &length);
  std::string hex;
  for (unsigned i = 0; i < length; ++i) {
    constexpr const char* kDigits = "0123456789abcdef";
    hex += kDigits[digest[i] >> 4];
    hex += kDigits[digest[i] & 15];
  }
  return hex;
}

}  // namespace patina
