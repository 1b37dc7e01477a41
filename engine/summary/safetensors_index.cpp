#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "engine/summary/tensor_index.h"

namespace patina {
namespace {

static_assert(std::endian::native == std::endian::little, "safetensors data are little-endian");

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxHeaderBytes = 16u << 20;
constexpr std::size_t kMaxDimensions = 8;

bool read_unsigned(const Json& json, std::uint64_t& number) {
  if (!json.is_number_unsigned()) return false;
  number = json.get<std::uint64_t>();
  return true;
}

TensorPlace check_entry(const std::filesystem::path& file, const std::string& name, const Json& json,
                        std::uint64_t data_bytes) {
  const auto bad = [&](const std::string& why) {
    refuse_network(file, "tensor '" + printable(name) + "' " + why);
  };
  if (!json.is_object() || !json.contains("dtype") || !json.contains("shape") ||
      !json.contains("data_offsets"))
    bad("is not described");
  if (json["dtype"] != "F32") bad("is not float32");
  const Json &shape = json["shape"], &offsets = json["data_offsets"];
  if (!shape.is_array() || shape.size() > kMaxDimensions) bad("has no usable shape");
  TensorPlace entry;
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

void check_no_overlap(const std::filesystem::path& file, const std::map<std::string, TensorPlace>& entries) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> spans;
  for (const auto& [name, entry] : entries) spans.emplace_back(entry.begin, entry.begin + entry.bytes);
  std::ranges::sort(spans);
  for (std::size_t i = 1; i < spans.size(); ++i)
    if (spans[i].first < spans[i - 1].second) refuse_network(file, "its tensors overlap");
}

Json parse_header(const RandomAccessFile& file, std::uint64_t& data_begin) {
  std::uint64_t length = 0;
  if (file.size() < sizeof length) refuse_network(file.path(), "it is too short");
  file.read(0, sizeof length, &length);
  if (length > kMaxHeaderBytes || length > file.size() - sizeof length)
    refuse_network(file.path(), "it is neither in the safetensors format nor a PyTorch checkpoint");
  data_begin = sizeof length + length;
  Json header = Json::parse(file.read(sizeof length, static_cast<std::size_t>(length)), nullptr, false);
  if (!header.is_object()) refuse_network(file.path(), "its header is not JSON");
  return header;
}

}  // namespace

TensorIndex index_safetensors(const RandomAccessFile& file) {
  std::uint64_t data_begin = 0;
  const Json header = parse_header(file, data_begin);
  TensorIndex index;
  for (const auto& [name, json] : header.items()) {
    if (name != "__metadata__") {
      index.tensors[name] = check_entry(file.path(), name, json, file.size() - data_begin);
      continue;
    }
    if (!json.is_object()) refuse_network(file.path(), "its metadata are not an object");
    for (const auto& [key, value] : json.items())
      if (value.is_string()) index.metadata[key] = value.get<std::string>();
  }
  check_no_overlap(file.path(), index.tensors);
  for (auto& [name, place] : index.tensors) place.begin += data_begin;
  return index;
}

}  // namespace patina
