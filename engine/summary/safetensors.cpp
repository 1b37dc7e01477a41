#include "engine/summary/safetensors.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/io/file.h"
#include "engine/summary/weights_file.h"

namespace patina {

SafeTensors read_safetensors(const std::filesystem::path& file) {
  const RandomAccessFile source(file, kMaxNetworkBytes);
  const TensorIndex index = index_safetensors(source);
  SafeTensors result{{}, index.metadata};
  for (const auto& [name, place] : index.tensors) result.tensors[name] = read_tensor(source, place);
  return result;
}

void write_safetensors(const std::filesystem::path& file, const SafeTensors& contents) {
  using Json = nlohmann::ordered_json;
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
