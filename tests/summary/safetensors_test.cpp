#include "engine/summary/safetensors.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/equal.h>

#include <cstring>
#include <random>

#include "engine/summary/network.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

std::string with_length(std::uint64_t length, const std::string& rest) {
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  return bytes + rest;
}

/// A file with this header and that many zero bytes of data.
std::string framed(const std::string& header, std::size_t data_bytes) {
  return with_length(header.size(), header + std::string(data_bytes, '\0'));
}

std::string slurp(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

using SafeTensorsFile = NetworkFiles;

TEST_F(SafeTensorsFile, ReadsWhatItWrote) {
  const SafeTensors written = small_network();
  const SafeTensors read = read_safetensors(file(written));
  EXPECT_EQ(read.metadata, written.metadata);
  ASSERT_EQ(read.tensors.size(), written.tensors.size());
  for (const auto& [name, tensor] : written.tensors)
    EXPECT_TRUE(at::equal(read.tensors.at(name), tensor)) << name;
}

TEST_F(SafeTensorsFile, WritesTheLayoutThatOthersRead) {
  SafeTensors contents;
  contents.tensors["t"] = random_tensor({2, 3}, 1).t();  // not contiguous in memory
  const std::string bytes = slurp(file(contents));
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  ASSERT_EQ(bytes.size(), sizeof length + length + 6 * sizeof(float));
  EXPECT_EQ((sizeof length + length) % 8, 0u);
  EXPECT_NE(bytes.find(R"("t":{"dtype":"F32","shape":[3,2],"data_offsets":[0,24]})"), std::string::npos);
  float second = 0;
  std::memcpy(&second, bytes.data() + sizeof length + length + sizeof second, sizeof second);
  EXPECT_EQ(second, contents.tensors["t"][0][1].item<float>());
}

struct Malformed {
  const char* what;
  std::string bytes;
  const char* message;
};

TEST_F(SafeTensorsFile, RefusesEveryMalformedFileInASentenceThatSaysWhy) {
  const std::string good = R"({"t":{"dtype":"F32","shape":[2,3],"data_offsets":[0,24]}})";
  ASSERT_NO_THROW(read_safetensors(file(framed(good, 24)))) << "the control: this one is good";
  const Malformed cases[] = {
      {"an empty file", "", "too short"},
      {"a truncated length", "\x10\0\0", "too short"},
      {"a truncated header", with_length(good.size(), good.substr(0, 20)),
       "neither in the safetensors format"},
      {"a huge header length", with_length(~0ull, good), "neither in the safetensors format"},
      {"a header length one byte past the end", with_length(good.size() + 25, good + std::string(24, '\0')),
       "neither in the safetensors format"},
      {"a JPEG", std::string("\xFF\xD8\xFF\xE0\0\x10JFIF\0\1\1\0\0\1\0\1\0\0", 24),
       "neither in the safetensors format"},
      {"a header that is not JSON", framed("{\"t\":", 24), "not JSON"},
      {"a header that is a list", framed("[1, 2]", 24), "not JSON"},
      {"deep nesting", framed(std::string(1'000'000, '['), 0), "not JSON"},
      {"metadata that are a list", framed(R"({"__metadata__":[1]})", 0), "metadata"},
      {"a tensor that is a number", framed(R"({"t":7})", 24), "is not described"},
      {"no offsets", framed(R"({"t":{"dtype":"F32","shape":[6]}})", 24), "is not described"},
      {"another dtype", framed(R"({"t":{"dtype":"F16","shape":[12],"data_offsets":[0,24]}})", 24),
       "not float32"},
      {"a dtype that is a number", framed(R"({"t":{"dtype":32,"shape":[6],"data_offsets":[0,24]}})", 24),
       "not float32"},
      {"an end past the data", framed(good, 23), "outside the file"},
      {"begin after end", framed(R"({"t":{"dtype":"F32","shape":[6],"data_offsets":[24,0]}})", 24),
       "outside"},
      {"a negative offset", framed(R"({"t":{"dtype":"F32","shape":[6],"data_offsets":[-24,0]}})", 24),
       "no usable place"},
      {"a fractional offset", framed(R"({"t":{"dtype":"F32","shape":[6],"data_offsets":[0.0,24]}})", 24),
       "no usable place"},
      {"three offsets", framed(R"({"t":{"dtype":"F32","shape":[6],"data_offsets":[0,24,24]}})", 24),
       "no usable place"},
      {"a shape that does not fit", framed(R"({"t":{"dtype":"F32","shape":[5],"data_offsets":[0,24]}})", 24),
       "does not fit its shape"},
      {"a shape whose product overflows to 6",
       framed(R"({"t":{"dtype":"F32","shape":[4294967296,4294967296,6],"data_offsets":[0,24]}})", 24),
       "no usable shape"},
      {"a product of possible extents that overflows",
       framed(R"({"t":{"dtype":"F32","shape":[24,24,24,24,24,24,24,24],"data_offsets":[0,24]}})", 24),
       "larger than the file"},
      {"a negative extent", framed(R"({"t":{"dtype":"F32","shape":[-6],"data_offsets":[0,24]}})", 24),
       "no usable shape"},
      {"an extent of zero", framed(R"({"t":{"dtype":"F32","shape":[0],"data_offsets":[0,0]}})", 24),
       "no usable shape"},
      {"nine dimensions",
       framed(R"({"t":{"dtype":"F32","shape":[1,1,1,1,1,1,1,1,6],"data_offsets":[0,24]}})", 24),
       "no usable shape"},
      {"overlapping tensors",
       framed(R"({"a":{"dtype":"F32","shape":[4],"data_offsets":[0,16]},)"
              R"("b":{"dtype":"F32","shape":[4],"data_offsets":[8,24]}})",
              24),
       "overlap"},
      {"a name with line breaks", framed("{\"a\\nb\\r" + std::string(5000, 'x') + "\":7}", 24), "a?b?xxx"},
  };
  for (const auto& [what, bytes, message] : cases) {
    const std::string said = user_error([&] { read_safetensors(file(bytes)); });
    EXPECT_NE(said.find(message), std::string::npos) << what << ": " << said;
  }
}

TEST_F(SafeTensorsFile, RefusesFilesThatAreMissingOrFolders) {
  EXPECT_NE(user_error([&] { read_safetensors(folder_ / "none.safetensors"); }), "");
  EXPECT_NE(user_error([&] { read_safetensors(folder_); }), "");
}

/// A valid file is changed in up to four places, mostly in its header, and loaded as a network: it loads or
/// is refused, nothing else; whatever loads also runs.
TEST_F(SafeTensorsFile, TakesOrRefusesRandomlyChangedNetworks) {
  const std::string good = slurp(file(small_network()));
  const at::Tensor image = random_tensor({3, 24, 24}, 9, 0.2) + 0.5;
  std::mt19937 generator(20);
  const auto below = [&](std::size_t n) { return generator() % n; };
  int loaded = 0, refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = good;
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
      const std::size_t at = below(8) ? below(1800) : below(bytes.size());
      switch (below(4)) {
        case 0:
          bytes[at % bytes.size()] = static_cast<char>(generator());
          break;
        case 1:
          bytes[at % bytes.size()] = "0123456789[]{},:\"-e."[below(20)];
          break;
        case 2:
          bytes.erase(at % bytes.size(), below(3));
          break;
        default:
          bytes.insert(at % bytes.size(), bytes.substr(below(1500), below(12)));
      }
    }
    const std::string said = user_error([&] {
      const Network network = Network::load(file(bytes));
      ++loaded;
      if (network.minimum_resolution() <= 24) network.features(image.unsqueeze(0));
    });
    refused += !said.empty();
  }
  EXPECT_EQ(loaded + refused, 3000);
  EXPECT_GT(loaded, 30) << "changes so rough that nothing behind the header was tried";
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace patina
