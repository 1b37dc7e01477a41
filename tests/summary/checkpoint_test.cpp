// PyTorch checkpoints: what good ones say, and that bad ones say nothing and do nothing.
#include <cstring>

#include "engine/summary/pickle.h"
#include "engine/summary/tensor_index.h"
#include "engine/summary/vgg19.h"
#include "tests/summary/checkpoint_files.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

const std::vector<WrittenTensor> kTensors{
    {"a.weight", {2, 3}, {3, 1}, "0", 6}, {"a.bias", {2}, {1}, "10", 5, 3}, {"number", {}, {}, "10", 5, 4}};
const std::map<std::string, std::vector<float>> kStorages{{"0", {1, 2, 3, 4, 5, 6}},
                                                          {"10", {7, 8, 9, 10, 11}}};

class Checkpoint : public NetworkFiles {
 protected:
  TensorIndex index(const std::string& bytes) const {
    return index_tensors(RandomAccessFile(file(bytes), kMaxNetworkBytes));
  }
  std::string refusal(const std::string& bytes) const {
    return user_error([&] { index(bytes); });
  }
  std::vector<float> values(const std::string& bytes, const std::string& name) const {
    const RandomAccessFile source(file(bytes), kMaxNetworkBytes);
    const TensorPlace place = index_tensors(source).tensors.at(name);
    std::vector<float> values(place.bytes / sizeof(float));
    source.read(place.begin, place.bytes, values.data());
    return values;
  }
  /// The complaint about the first tensor with a change, in both layouts.
  std::string refusal(void (*change)(WrittenTensor&)) const {
    std::vector<WrittenTensor> tensors = kTensors;
    change(tensors.front());
    const std::string zip = refusal(zip_checkpoint(state_dict_pickle(tensors), kStorages));
    EXPECT_EQ(refusal(legacy_checkpoint(state_dict_pickle(tensors, true), kStorages)), zip);
    return zip;
  }
};

TEST_F(Checkpoint, TensorsAreWhereTheyWereWrittenInBothLayoutsAndByEveryRebuilder) {
  for (const char* rebuild : {"_rebuild_tensor", "_rebuild_tensor_v2"})
    for (const std::string& bytes :
         {zip_checkpoint(state_dict_pickle(kTensors, false, rebuild), kStorages),
          legacy_checkpoint(state_dict_pickle(kTensors, true, rebuild), kStorages)}) {
      EXPECT_EQ(index(bytes).tensors.size(), 3u);
      EXPECT_EQ(index(bytes).tensors.at("a.weight").shape, (std::vector<std::int64_t>{2, 3}));
      EXPECT_EQ(values(bytes, "a.weight"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
      EXPECT_EQ(values(bytes, "a.bias"), (std::vector<float>{10, 11}));
      EXPECT_EQ(values(bytes, "number"), (std::vector<float>{11}));
    }
}

TEST_F(Checkpoint, TensorsThatDoNotFitTheirStoragesAreRefused) {
  EXPECT_EQ(refusal([](WrittenTensor&) {}), "") << "the control: this one is good";
  const auto expect = [&](void (*change)(WrittenTensor&), const char* message) {
    const std::string said = refusal(change);
    EXPECT_NE(said.find(message), std::string::npos) << said;
  };
  expect([](WrittenTensor& t) { t.shape = {3, 3}; }, "larger than its storage");
  expect([](WrittenTensor& t) { t.shape = {-2, -3}; }, "larger than its storage");
  expect([](WrittenTensor& t) { t.shape = {0, 3}; }, "larger than its storage");
  expect([](WrittenTensor& t) { t.shape = {1ll << 62, 4}; }, "larger than its storage");
  expect([](WrittenTensor& t) { t.shape.assign(9, 1), t.strides.assign(9, 1); }, "8 dimensions");
  expect([](WrittenTensor& t) { t.strides = {1, 2}; }, "not contiguous");
  expect([](WrittenTensor& t) { t.strides = {1}; }, "strides");
  expect([](WrittenTensor& t) { t.offset = 1; }, "outside its storage");
  expect([](WrittenTensor& t) { t.offset = -1; }, "outside its storage");
  expect([](WrittenTensor& t) { t.offset = std::int64_t{1} << 62; }, "outside its storage");
  expect([](WrittenTensor& t) { t.storage_elements = 1 << 30; }, "does not fit");
  expect([](WrittenTensor& t) { t.storage_elements = -6; }, "does not fit");
  expect([](WrittenTensor& t) { t.key = "../0"; }, "storage is missing");
  expect([](WrittenTensor& t) { t.storage_type = "HalfStorage"; }, "HalfStorage");
}

TEST_F(Checkpoint, APickleThatWantsToRunSomethingIsRefusedByTheNameOfWhatItWants) {
  using namespace pickled;
  const std::string mark = (folder_ / "it-ran").string();
  const std::string shell = tuple({text("touch " + mark)});
  const std::pair<std::string, const char*> cases[] = {
      {call(name("os", "system"), shell), "os.system"},
      {call(name("posix", "system"), shell), "posix.system"},
      {call(name("builtins", "eval"), shell), "builtins.eval"},
      {call(name("torch", "load"), shell), "torch.load"},
      {call(name("collections", "OrderedDict"), shell), "collections.OrderedDict"},
      {call(name("torch._utils", "_rebuild_tensor_v3"), shell), "_rebuild_tensor_v3"},
      {"(" + text("touch " + mark) + "ios\nsystem\n", "opcode 105"},             // INST
      {"(" + name("os", "system") + text("touch " + mark) + "o", "opcode 111"},  // OBJ
      {name("os", "system") + shell + "\x81", "opcode 129"},                     // NEWOBJ
      {text("os") + text("system") + "\x93" + shell + "R", "opcode 147"},        // STACK_GLOBAL
      {"\x82\x01" + shell + "R", "opcode 130"},                                  // EXT1
      {name("a\tb", "c\x01") + ")R", "a?b.c?"},
      {tuple({text("module"), name("torch", "FloatStorage"), text("0"), text("cpu"), "K\1"}) + "Q",
       "storage"},
      {tuple({text("storage"), name("os", "system"), text("0"), text("cpu"), "K\1"}) + "Q", "os.system"},
  };
  for (const auto& [value, message] : cases)
    for (const std::string& bytes :
         {zip_checkpoint(complete(value), kStorages), legacy_checkpoint(complete(value), kStorages)}) {
      const std::string said = refusal(bytes);
      EXPECT_NE(said.find(message), std::string::npos) << message << ": " << said;
    }
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST_F(Checkpoint, APickleThatIsNoStateDictIsRefused) {
  using namespace pickled;
  const auto said = [&](const std::string& pickle) { return refusal(zip_checkpoint(pickle, kStorages)); };
  const std::string good = tensor(kTensors.front(), false, "_rebuild_tensor_v2");
  EXPECT_EQ(said(complete(state_dict({text("a"), good}))), "") << "the control: this one is good";
  EXPECT_EQ(said(complete("}" + text("a") + good + "s")), "") << "and so is a plain dictionary";
  for (const std::string& bad : {complete(good),
                                 complete("N"),
                                 complete(state_dict({text("a"), text("b")})),
                                 complete(state_dict({"K\1", good})),
                                 complete(state_dict({text("a"), state_dict({})})),
                                 complete(state_dict({text("a")})),
                                 std::string("\x80\x04N.", 4),
                                 std::string("."),
                                 std::string("t"),
                                 std::string("a"),
                                 std::string("u"),
                                 std::string("e"),
                                 std::string("R"),
                                 std::string("Q"),
                                 std::string("b"),
                                 std::string("h\0", 2),
                                 std::string("q\0", 2),
                                 complete("(("),
                                 complete("]a"),
                                 complete("X\xff\xff\xff\xff"),
                                 complete("\x8a\xff"),
                                 complete("cos"),
                                 std::string()})
    EXPECT_NE(said(bad), "") << bad;
}

TEST_F(Checkpoint, BombsAreDefusedInLittleTimeAndMemory) {
  const auto said = [&](const std::string& pickle) { return refusal(zip_checkpoint(pickle, kStorages)); };
  EXPECT_NE(said(pickled::complete(")" + std::string(900'000, '\x85'))), "") << "tuples in tuples";
  EXPECT_NE(said(pickled::complete("]" + std::string("q\0h\0a", 5))), "") << "a list in itself";
  std::string copies = pickled::text(std::string(400'000, 'x')) + std::string("q\0", 2);
  for (int i = 0; i < 200'000; ++i) copies += std::string("h\0", 2);
  EXPECT_NE(said(pickled::complete(copies)), "") << "a long text, a hundred thousand times";
  EXPECT_NE(said(pickled::complete("Nr\xff\xff\xff\xff")), "") << "a memory at the end of a huge memo";
  EXPECT_NE(said(std::string(2'000'000, '(')).find("too long"), std::string::npos);
}

TEST_F(Checkpoint, EveryTruncatedFileIsRefused) {
  for (const std::string& good : {zip_checkpoint(state_dict_pickle(kTensors), kStorages),
                                  legacy_checkpoint(state_dict_pickle(kTensors, true), kStorages)}) {
    ASSERT_EQ(refusal(good), "");
    for (std::size_t length = 0; length < good.size(); ++length)
      ASSERT_NE(refusal(good.substr(0, length)), "") << length << " of " << good.size();
  }
}

TEST_F(Checkpoint, ArchivesThatAreNotTorchSavesAreRefused) {
  EXPECT_NE(refusal(zip_of({{"word/document.xml", "<xml>"}})).find("no data.pkl"), std::string::npos);
  const std::string pickle = state_dict_pickle(kTensors);
  const std::map<std::string, std::string> big{{"n/data.pkl", pickle}, {"n/byteorder", "big"}};
  EXPECT_NE(refusal(zip_of(big)).find("little-endian"), std::string::npos);
  std::string compressed = zip_checkpoint(pickle, kStorages);
  compressed[compressed.find("PK\1\2") + 10] = 8;
  EXPECT_NE(refusal(compressed).find("compressed"), std::string::npos);
  std::string far = zip_checkpoint(pickle, kStorages);
  std::memset(far.data() + far.find("PK\1\2") + 42, 0xff, 4);
  EXPECT_NE(refusal(far).find("damaged"), std::string::npos);
}

TEST_F(Checkpoint, AHashInTheFileNameMustBeginTheFilesSha256) {
  const auto named = [&](const std::string& name) {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << "abc";  // FIPS 180-2's example: ba7816bf 8f01cfea ...
    return user_error([&] { check_hash_in_name(RandomAccessFile(path, 10)); });
  };
  EXPECT_EQ(named("vgg19-ba7816bf.pth"), "");
  EXPECT_EQ(named("vgg19-ba7816bf8f01cfea.pt"), "");
  EXPECT_NE(named("vgg19-dcbb9e9d.pth").find("dcbb9e9d"), std::string::npos);
  for (const char* free : {"vgg19.pth", "vgg19-dcbb9e9d.safetensors", "my-network.pth", "a-12.pth"})
    EXPECT_EQ(named(free), "") << free;
}

TEST(Vgg19, IsKnownByTheNamesAndShapesOfItsSixteenConvolutions) {
  TensorIndex index;
  EXPECT_FALSE(looks_like_vgg(index));
  const std::vector<std::int64_t> channels{64,  64,  128, 128, 256, 256, 256, 256,
                                           512, 512, 512, 512, 512, 512, 512, 512};
  const std::vector<int> modules{0, 2, 5, 7, 10, 12, 14, 16, 19, 21, 23, 25, 28, 30, 32, 34};
  std::int64_t in = 3;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string name = "features." + std::to_string(modules[i]);
    index.tensors[name + ".weight"].shape = {channels[i], in, 3, 3};
    index.tensors[name + ".bias"].shape = {channels[i]};
    in = channels[i];
  }
  EXPECT_TRUE(looks_like_vgg(index));
  EXPECT_EQ(user_error([&] { describe_vgg19("vgg.pth", index); }), "");
  TensorIndex deeper = index, other = index;
  deeper.tensors.erase("features.34.bias");
  EXPECT_NE(user_error([&] { describe_vgg19("v.pth", deeper); }).find("'features.34.bias' is missing"),
            std::string::npos);
  other.tensors["features.5.weight"].shape = {128, 64, 5, 5};
  EXPECT_NE(user_error([&] { describe_vgg19("v.pth", other); }).find("'features.5.weight' has another shape"),
            std::string::npos);
}

}  // namespace
}  // namespace patina
