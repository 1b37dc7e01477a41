// Network files: the fuzz of parser_fuzz.h.
#include <cstring>

#include "engine/summary/tensor_index.h"
#include "tests/io_fuzz/parser_fuzz.h"
#include "tests/summary/checkpoint_files.h"

namespace patina {
namespace {

const std::vector<WrittenTensor> kTensors{{"a.weight", {2, 3}, {3, 1}, "0", 6},
                                          {"a.bias", {2}, {1}, "1", 5, 3}};
const std::map<std::string, std::vector<float>> kStorages{{"0", {1, 2, 3, 4, 5, 6}},
                                                          {"1", {7, 8, 9, 10, 11}}};

/// Whatever is taken can be read in full.
void read_all(const std::filesystem::path& path) {
  const RandomAccessFile file(path, kMaxNetworkBytes);
  for (const auto& [name, place] : index_tensors(file).tensors) {
    std::uint64_t elements = 1;
    for (const std::int64_t size : place.shape) elements *= static_cast<std::uint64_t>(size);
    ASSERT_EQ(place.bytes, elements * sizeof(float)) << name;
    file.read(place.begin, static_cast<std::size_t>(place.bytes));
  }
}

TEST_F(ParserFuzz, CheckpointArchives) {
  fuzz(zip_checkpoint(state_dict_pickle(kTensors), kStorages), 6000, 400, read_all);
}

TEST_F(ParserFuzz, CheckpointsOfTheOldLayout) {
  fuzz(legacy_checkpoint(state_dict_pickle(kTensors, true), kStorages), 6000, 500, read_all);
}

TEST_F(ParserFuzz, SafeTensors) {
  const std::string header =
      R"({"__metadata__":{"a":"b"},"t":{"dtype":"F32","shape":[2,3],"data_offsets":[0,24]},)"
      R"("u":{"dtype":"F32","shape":[2],"data_offsets":[24,32]}})";
  const std::uint64_t length = header.size();
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  fuzz(bytes + header + std::string(32, '\1'), 6000, 600, read_all);
}

}  // namespace
}  // namespace patina
