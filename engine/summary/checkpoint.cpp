// PyTorch checkpoints: which bytes of the file are which tensor of the state dict.
#include <bit>
#include <cstring>

#include "engine/summary/pickle.h"
#include "engine/summary/tensor_index.h"
#include "engine/summary/zip_index.h"

namespace patina {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are read as little-endian");

// VGG-19's has 3 kB; a state dict of thousands of tensors stays below this.
constexpr std::uint64_t kMaxPickleBytes = 1u << 20;

using Storages = std::map<std::string, FileSpan, std::less<>>;

/// The number of elements of a contiguous view, checked to lie within its storage.
std::uint64_t checked_elements(const PickleTensor& tensor) {
  const auto available = static_cast<std::uint64_t>(tensor.storage.elements);
  std::uint64_t elements = 1;
  if (tensor.strides.size() != tensor.shape.size())
    throw BadPickle("a tensor's strides do not fit its shape");
  for (std::size_t i = tensor.shape.size(); i-- > 0;) {
    const std::int64_t size = tensor.shape[i];
    if (size <= 0 || static_cast<std::uint64_t>(size) > available / elements)
      throw BadPickle("a tensor is larger than its storage");
    if (size > 1 && tensor.strides[i] != static_cast<std::int64_t>(elements))
      throw BadPickle("a tensor is not contiguous");
    elements *= static_cast<std::uint64_t>(size);
  }
  if (tensor.offset < 0 || static_cast<std::uint64_t>(tensor.offset) > available - elements)
    throw BadPickle("a tensor lies outside its storage");
  return elements;
}

TensorPlace place_of(const PickleTensor& tensor, const Storages& storages) {
  const auto storage = storages.find(tensor.storage.key);
  if (storage == storages.end()) throw BadPickle("a storage is missing");
  if (tensor.storage.type != "FloatStorage")
    throw BadPickle("a tensor is not float32 but of a " + printable(std::string(tensor.storage.type)));
  if (tensor.storage.elements <= 0 || storage->second.bytes % sizeof(float) != 0 ||
      storage->second.bytes / sizeof(float) != static_cast<std::uint64_t>(tensor.storage.elements))
    throw BadPickle("a storage has a size that does not fit");
  const std::uint64_t elements = checked_elements(tensor);
  return {tensor.shape, storage->second.begin + static_cast<std::uint64_t>(tensor.offset) * sizeof(float),
          elements * sizeof(float)};
}

TensorIndex index_state_dict(const PickleValue& state, const Storages& storages) {
  const auto* dictionary = std::get_if<PickleDictionary*>(&state);
  if (!dictionary) throw BadPickle("it holds no state dict");
  TensorIndex index;
  for (const auto& [key, value] : (*dictionary)->entries) {
    const auto* name = std::get_if<std::string_view>(&key);
    const auto* tensor = std::get_if<std::shared_ptr<const PickleTensor>>(&value);
    if (!name || !tensor)
      throw BadPickle("it holds more than a state dict of tensors: save model.state_dict() alone");
    index.tensors[std::string(*name)] = place_of(**tensor, storages);
  }
  return index;
}

/// ARCHIVE/data.pkl and, for each storage, ARCHIVE/data/KEY.
TensorIndex index_zip(const RandomAccessFile& file) {
  constexpr std::string_view kPickle = "/data.pkl";
  const std::map<std::string, FileSpan> entries = index_stored_zip(file);
  for (const auto& [name, span] : entries) {
    if (!name.ends_with(kPickle)) continue;
    if (span.bytes > kMaxPickleBytes) throw BadPickle("its pickle is too long for a state dict");
    const std::string archive = name.substr(0, name.size() - kPickle.size());
    const auto order = entries.find(archive + "/byteorder");
    if (order != entries.end() && (order->second.bytes != 6 || file.read(order->second.begin, 6) != "little"))
      throw BadPickle("its numbers are not little-endian");
    Storages storages;
    const std::string folder = archive + "/data/";
    for (const auto& [entry, place] : entries)
      if (entry.starts_with(folder)) storages[entry.substr(folder.size())] = place;
    const std::string pickle = file.read(span.begin, static_cast<std::size_t>(span.bytes));
    PickleReader reader(pickle);
    return index_state_dict(reader.load(), storages);
  }
  throw BadPickle("its zip archive has no data.pkl, so it is not a PyTorch checkpoint");
}

/// The spans of the storages that follow the pickles: for each key, in order, its length and its numbers.
Storages legacy_storages(const RandomAccessFile& file, std::uint64_t begin, const PickleValue& keys) {
  const auto* list = std::get_if<PickleItems*>(&keys);
  if (!list) throw BadPickle("it has no list of storages");
  Storages storages;
  for (const PickleValue& value : (*list)->values) {
    const auto* key = std::get_if<std::string_view>(&value);
    std::uint64_t elements = 0;
    if (!key || file.size() - begin < sizeof elements) throw BadPickle("it ends too early");
    file.read(begin, sizeof elements, &elements);
    begin += sizeof elements;
    if (elements > (file.size() - begin) / sizeof(float)) throw BadPickle("it ends too early");
    storages[std::string(*key)] = {begin, elements * sizeof(float)};
    begin += elements * sizeof(float);
  }
  return storages;
}

/// Five pickles (magic number, version, system, state dict, storage keys), then the storages.
TensorIndex index_legacy(const RandomAccessFile& file) {
  constexpr std::string_view kMagic("\x6c\xfc\x9c\x46\xf9\x20\x6a\xa8\x50\x19", 10);
  constexpr std::int64_t kVersion = 1001;
  const std::string start = file.read(0, static_cast<std::size_t>(std::min(file.size(), kMaxPickleBytes)));
  PickleReader reader(start);
  if (reader.load() != PickleValue(kMagic) || reader.load() != PickleValue(kVersion))
    throw BadPickle("it is a pickle, but not of a PyTorch checkpoint");
  reader.load();  // sizes of C's types where it was written; float32 has the same everywhere
  const PickleValue state = reader.load();
  const PickleValue keys = reader.load();
  return index_state_dict(state, legacy_storages(file, reader.position(), keys));
}

}  // namespace

TensorIndex index_checkpoint(const RandomAccessFile& file) {
  try {
    return file.read(0, std::min<std::size_t>(file.size(), 1)) == "P" ? index_zip(file) : index_legacy(file);
  } catch (const BadPickle& error) {
    refuse_network(file.path(), error.what());
  }
}

}  // namespace patina
