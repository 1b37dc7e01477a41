#include "engine/summary/zip_index.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "engine/summary/tensor_index.h"

namespace patina {
namespace {

static_assert(std::endian::native == std::endian::little, "zip archives are little-endian");

constexpr std::size_t kEndBytes = 22, kEntryBytes = 46, kLocalBytes = 30;
constexpr std::size_t kMaxComment = 65535;
constexpr std::uint64_t kMaxDirectoryBytes = 4u << 20;

template <typename Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

[[noreturn]] void refuse_damaged(const RandomAccessFile& file) {
  refuse_network(file.path(), "its zip archive is damaged or cut short");
}

/// The central directory's bytes.
std::string read_directory(const RandomAccessFile& file) {
  const auto tail_bytes =
      static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kEndBytes + kMaxComment));
  const std::string tail = file.read(file.size() - tail_bytes, tail_bytes);
  const std::size_t end = tail.rfind("PK\5\6");
  if (end == std::string::npos || tail.size() - end < kEndBytes) refuse_damaged(file);
  const std::uint64_t bytes = number_at<std::uint32_t>(tail, end + 12);
  const std::uint64_t begin = number_at<std::uint32_t>(tail, end + 16);
  if (bytes > kMaxDirectoryBytes || begin > file.size() || bytes > file.size() - begin) refuse_damaged(file);
  return file.read(begin, static_cast<std::size_t>(bytes));
}

/// Where the data begin of the entry whose local header is at `header`.
FileSpan span_of(const RandomAccessFile& file, std::uint64_t header, std::uint64_t bytes) {
  if (header > file.size() || kLocalBytes > file.size() - header) refuse_damaged(file);
  const std::string local = file.read(header, kLocalBytes);
  if (!local.starts_with("PK\3\4")) refuse_damaged(file);
  const std::uint64_t begin =
      header + kLocalBytes + number_at<std::uint16_t>(local, 26) + number_at<std::uint16_t>(local, 28);
  if (begin > file.size() || bytes > file.size() - begin) refuse_damaged(file);
  return {begin, bytes};
}

}  // namespace

std::map<std::string, FileSpan> index_stored_zip(const RandomAccessFile& file) {
  const std::string directory = read_directory(file);
  std::map<std::string, FileSpan> spans;
  for (std::size_t at = 0; at < directory.size();) {
    if (directory.size() - at < kEntryBytes || directory.compare(at, 4, "PK\1\2") != 0) refuse_damaged(file);
    const std::size_t name_bytes = number_at<std::uint16_t>(directory, at + 28);
    const std::size_t rest = std::size_t{number_at<std::uint16_t>(directory, at + 30)} +
                             number_at<std::uint16_t>(directory, at + 32);
    if (name_bytes + rest > directory.size() - at - kEntryBytes) refuse_damaged(file);
    const std::string name = directory.substr(at + kEntryBytes, name_bytes);
    if (number_at<std::uint16_t>(directory, at + 10) != 0)
      refuse_network(file.path(), "its zip archive is compressed, which torch.save's are not");
    // Archives beyond 4 GB write 0xFFFFFFFF here: they are far too large and lie outside the file.
    const FileSpan span = span_of(file, number_at<std::uint32_t>(directory, at + 42),
                                  number_at<std::uint32_t>(directory, at + 24));
    if (!spans.emplace(name, span).second) refuse_damaged(file);
    at += kEntryBytes + name_bytes + rest;
  }
  return spans;
}

}  // namespace patina
