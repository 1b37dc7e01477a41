#include "engine/summary/tensor_index.h"

#include <algorithm>

#include "engine/error.h"

namespace patina {

TensorIndex index_tensors(const RandomAccessFile& file) {
  const std::string start = file.read(0, static_cast<std::size_t>(std::min<std::uint64_t>(4, file.size())));
  // A zip archive; a pickle of a ten-byte integer. As lengths of a safetensors header both are out of range.
  const bool checkpoint = start == "PK\3\4" || start == "\x80\x02\x8a\x0a";
  return checkpoint ? index_checkpoint(file) : index_safetensors(file);
}

void check_hash_in_name(const RandomAccessFile& file) {
  const std::string extension = file.path().extension(), stem = file.path().stem();
  const std::string digits = stem.substr(std::min(stem.rfind('-'), stem.size() - 1) + 1);
  constexpr std::size_t kFewestDigits = 8;
  if ((extension != ".pth" && extension != ".pt") || digits.size() < kFewestDigits ||
      digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    return;
  if (!file.sha256_hex().starts_with(digits))
    refuse_network(file.path(), "its SHA-256 does not begin with " + printable(digits) +
                                    " as its name says, so it is damaged or another file");
}

std::string printable(std::string name) {
  name.resize(std::min<std::size_t>(name.size(), 80));
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return name;
}

void refuse_network(const std::filesystem::path& file, const std::string& why) {
  throw UserError("The network file " + printable(file.filename().string()) + " cannot be used: " + why +
                  "; give another one or leave --network out.");
}

}  // namespace patina
