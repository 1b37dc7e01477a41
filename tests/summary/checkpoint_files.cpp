#include "tests/summary/checkpoint_files.h"

#include <cstring>

namespace patina {
namespace {

template <typename Number>
std::string bytes_of(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::string bytes_of(const std::vector<float>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

std::string numbers(const std::vector<std::int64_t>& values) {
  std::vector<std::string> items;
  for (const std::int64_t value : values) items.push_back(pickled::number(value));
  return pickled::tuple(items);
}

}  // namespace

namespace pickled {

std::string text(std::string_view value) {
  return "X" + bytes_of(static_cast<std::uint32_t>(value.size())) + std::string(value);
}

std::string number(std::int64_t value) {
  if (value == static_cast<std::int32_t>(value)) return "J" + bytes_of(static_cast<std::int32_t>(value));
  return "\x8a\x08" + bytes_of(value);
}

std::string tuple(const std::vector<std::string>& items) {
  std::string bytes = "(";
  for (const std::string& item : items) bytes += item;
  return bytes + "t";
}

std::string name(std::string_view module, std::string_view name) {
  return "c" + std::string(module) + "\n" + std::string(name) + "\n";
}

std::string call(const std::string& function, const std::string& arguments) {
  return function + arguments + "R";
}

std::string tensor(const WrittenTensor& tensor, bool legacy, const std::string& rebuild) {
  std::vector<std::string> id{text("storage"), name("torch", tensor.storage_type), text(tensor.key),
                              text("cpu"), number(tensor.storage_elements)};
  if (legacy) id.emplace_back("N");
  std::vector<std::string> arguments{tuple(id) + "Q", number(tensor.offset), numbers(tensor.shape),
                                     numbers(tensor.strides)};
  if (rebuild != "_rebuild_tensor") {
    arguments.emplace_back("\x89");
    arguments.push_back(call(name("collections", "OrderedDict"), ")"));
  }
  return call(name("torch._utils", rebuild), tuple(arguments));
}

std::string state_dict(const std::vector<std::string>& keys_and_values) {
  std::string bytes = call(name("collections", "OrderedDict"), ")") + std::string("q\0(", 3);
  for (const std::string& item : keys_and_values) bytes += item;
  return bytes + "u}" + text("_metadata") + call(name("collections", "OrderedDict"), ")") + "sb";
}

std::string complete(const std::string& value) { return "\x80\x02" + value + "."; }

}  // namespace pickled

std::string state_dict_pickle(const std::vector<WrittenTensor>& tensors, bool legacy,
                              const std::string& rebuild) {
  std::vector<std::string> items;
  for (const WrittenTensor& tensor : tensors) {
    items.push_back(pickled::text(tensor.name));
    items.push_back(pickled::tensor(tensor, legacy, rebuild));
  }
  return pickled::complete(pickled::state_dict(items));
}

std::string zip_of(const std::map<std::string, std::string>& entries) {
  const auto u16 = [](std::size_t value) { return bytes_of(static_cast<std::uint16_t>(value)); };
  const auto u32 = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  std::string archive, directory;
  for (const auto& [name, contents] : entries) {
    const std::string sizes = u32(0) + u32(contents.size()) + u32(contents.size()) + u16(name.size());
    directory +=
        "PK\1\2" + std::string(12, '\0') + sizes + std::string(12, '\0') + u32(archive.size()) + name;
    archive += "PK\3\4" + std::string(10, '\0') + sizes + u16(0) + name + contents;
  }
  const std::size_t begin = archive.size();
  return archive + directory + "PK\5\6" + std::string(4, '\0') + u16(entries.size()) + u16(entries.size()) +
         u32(directory.size()) + u32(begin) + u16(0);
}

std::string zip_checkpoint(const std::string& pickle,
                           const std::map<std::string, std::vector<float>>& storages) {
  std::map<std::string, std::string> entries{
      {"net/data.pkl", pickle}, {"net/version", "3\n"}, {"net/byteorder", "little"}};
  for (const auto& [key, values] : storages) entries["net/data/" + key] = bytes_of(values);
  return zip_of(entries);
}

std::string legacy_checkpoint(const std::string& pickle,
                              const std::map<std::string, std::vector<float>>& storages) {
  using pickled::complete, pickled::text;
  std::string bytes = complete("\x8a\x0a\x6c\xfc\x9c\x46\xf9\x20\x6a\xa8\x50\x19") + complete("M\xe9\x03") +
                      complete("}(" + text("little_endian") + "\x88" + "u") + pickle;
  std::string keys, data;
  for (const auto& [key, values] : storages) {
    keys += text(key);
    data += bytes_of(std::int64_t(values.size())) + bytes_of(values);
  }
  return bytes + complete("](" + keys + "e") + data;
}

}  // namespace patina
