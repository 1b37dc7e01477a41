#include "engine/summary/safetensors.h"

#include <ATen/ops/empty.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

static_assert(std::endian::native == std::endian::little, "safetensors data are little-endian");

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxFileBytes = 600'000'000;  // VGG-19 with its classifier has 575 MB
constexpr std::uint64_t kMaxHeaderBytes = 16u << 20;
constexpr std::size_t kMaxDimensions = 8;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw UserError("The network file " + file.filename().string() + " cannot be used: " + why +
                  "; give a .safetensors file.");
}

/// Where a tensor's bytes lie, once everything about it has been checked.
struct Entry {
  std::vector<std::int64_t> shape;
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

bool read_unsigned(const Json& json, std::uint64_t& number) {
  if (!json.is_number_unsigned()) return false;
  number = json.get<std::uint64_t>();
  return true;
}

Entry check_entry(const std::filesystem::path& file, const std::string& name, const Json& json,
                  std::uint64_t data_bytes) {
  const auto bad = [&](const std::string& why) { refuse(file, "tensor '" + printable(name) + "' " + why); };
  if (!json.is_object() || !json.contains("dtype") || !json.contains("shape") ||
      !json.contains("data_offsets"))
    bad("is not described");
  if (json["dtype"] != "F32") bad("is not float32");
  const Json &shape = json["shape"], &offsets = json["data_offsets"];
  if (!shape.is_array() || shape.size() > kMaxDimensions) bad("has no usable shape");
  Entry entry;
  std::uint64_t elements = 1;
  for (const Json& extent : shape) {
    std::uint64_t size = 0;
    if (!read_unsigned(extent, size) || size == 0 || size > data_bytes) bad("has no usable shape");
    if (elements > data_bytes / size) bad("is larger than the file");
    elements *= size;
    entry.shape.push_back(static_cast<std::int64_t>(size));
  }
  std::uint64_t end = 0;
  if (!offsets.is_array() || offsets.size() != 2 || !read_unsigned(offsets[0], entry.begin) ||
      !read_unsigned(offsets[1], end))
    bad("has no usable place");
  if (entry.begin > end || end > data_bytes) bad("lies outside the file");
  entry.bytes = end - entry.begin;
  if (entry.bytes != elements * sizeof(float)) bad("has a size that does not fit its shape");
  return entry;
}

void check_no_overlap(const std::filesystem::path& file, const std::map<std::string, Entry>& entries) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> spans;
  for (const auto& [name, entry] : entries) spans.emplace_back(entry.begin, entry.begin + entry.bytes);
  std::ranges::sort(spans);
  for (std::size_t i = 1; i < spans.size(); ++i)
    if (spans[i].first < spans[i - 1].second) refuse(file, "its tensors overlap");
}

Json parse_header(const std::filesystem::path& file, const std::string& bytes, std::uint64_t& data_begin) {
  std::uint64_t length = 0;
  if (bytes.size() < sizeof length) refuse(file, "it is too short");
  std::memcpy(&length, bytes.data(), sizeof length);
  if (length > kMaxHeaderBytes || length > bytes.size() - sizeof length)
    refuse(file, "it is not in the safetensors format");
  data_begin = sizeof length + length;
  Json header = Json::parse(bytes.begin() + sizeof length,
                            bytes.begin() + static_cast<std::ptrdiff_t>(data_begin), nullptr, false);
  if (!header.is_object()) refuse(file, "its header is not JSON");
  return header;
}

}  // namespace

std::string printable(std::string name) {
  name.resize(std::min<std::size_t>(name.size(), 80));
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return name;
}

SafeTensors read_safetensors(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, kMaxFileBytes);
  std::uint64_t data_begin = 0;
  const Json header = parse_header(file, bytes, data_begin);

  SafeTensors result;
  std::map<std::string, Entry> entries;
  for (const auto& [name, json] : header.items()) {
    if (name != "__metadata__") {
      entries[name] = check_entry(file, name, json, bytes.size() - data_begin);
      continue;
    }
    if (!json.is_object()) refuse(file, "its metadata are not an object");
    for (const auto& [key, value] : json.items())
      if (value.is_string()) result.metadata[key] = value.get<std::string>();
  }
  check_no_overlap(file, entries);
  for (const auto& [name, entry] : entries) {
    at::Tensor tensor = at::empty(entry.shape, at::kFloat);
    std::memcpy(tensor.data_ptr<float>(), bytes.data() + data_begin + entry.begin, entry.bytes);
    result.tensors[name] = std::move(tensor);
  }
  return result;
}

void write_safetensors(const std::filesystem::path& file, const SafeTensors& contents) {
  Json header = Json::object();
  header["__metadata__"] = contents.metadata;
  std::string data;
  for (const auto& [name, tensor] : contents.tensors) {
    const at::Tensor plain = tensor.to(at::kFloat).contiguous();
    const std::size_t begin = data.size();
    data.append(static_cast<const char*>(plain.data_ptr()), plain.nbytes());
    header[name] = {{"dtype", "F32"}, {"shape", plain.sizes().vec()}, {"data_offsets", {begin, data.size()}}};
  }
  std::string text = header.dump();
  text.resize((text.size() + 7) / 8 * 8, ' ');  // keeps the data aligned
  const std::uint64_t length = text.size();
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  write_file_atomically(file, bytes + text + data);
}

}  // namespace patina
