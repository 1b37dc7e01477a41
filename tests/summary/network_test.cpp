#include "engine/summary/network.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/full.h>
#include <ATen/ops/stack.h>

#include <cmath>
#include <limits>

#include "engine/summary/bin_means.h"
#include "engine/summary/gram.h"
#include "engine/summary/summary.h"
#include "tests/summary/gradients.h"
#include "tests/summary/naive.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

void expect_equal(const at::Tensor& actual, const naive::Maps& expected, double tolerance) {
  const naive::Maps maps = naive::from_tensor(actual);
  ASSERT_EQ(maps.channels, expected.channels);
  ASSERT_EQ(maps.height, expected.height);
  ASSERT_EQ(maps.width, expected.width);
  for (std::size_t i = 0; i < maps.values.size(); ++i)
    ASSERT_NEAR(maps.values[i], expected.values[i], tolerance) << "at " << i;
}

using NetworkTest = NetworkFiles;

TEST_F(NetworkTest, FeaturesEqualPlainLoopsInDouble) {
  const SafeTensors contents = small_network();
  const Network network = Network::load(file(contents));
  for (const std::int64_t side : {16, 19}) {  // an odd side loses a row and a column to each pooling
    const at::Tensor image = random_image(side);
    const double mean[3] = {0.5, 0.4, 0.3}, std[3] = {0.2, 0.3, 0.4};
    const auto conv = [&](const naive::Maps& x, const char* name, bool relu) {
      return naive::convolved(x, contents, name, relu);
    };
    naive::Maps trunk = conv(naive::normalised(naive::from_tensor(image), mean, std), "a", true);
    const std::vector<at::Tensor> features = network.features(image.unsqueeze(0));
    ASSERT_EQ(features.size(), 3u);
    expect_equal(features[0][0], trunk, 1e-5);
    trunk = conv(naive::average_pooled(trunk), "b", false);
    expect_equal(features[1][0], conv(conv(trunk, "aside1", true), "aside2", true), 1e-5);
    trunk = conv(naive::max_pooled(trunk), "c", true);
    expect_equal(features[2][0], trunk, 1e-5);
  }
}

/// A description whose padding is that JSON value.
SafeTensors with_padding(SafeTensors contents, const std::string& padding) {
  contents.metadata["patina_network"].insert(1, "\"padding\": " + padding + ", ");
  return contents;
}

TEST_F(NetworkTest, PadsWithZerosWhereItsDescriptionSaysSo) {
  const SafeTensors contents = with_layers(R"([{"op": "conv", "weights": "a"}, {"op": "tap"}])");
  const at::Tensor image = random_image(9);
  const double mean[3] = {0.5, 0.4, 0.3}, std[3] = {0.2, 0.3, 0.4};
  const naive::Maps input = naive::normalised(naive::from_tensor(image), mean, std);
  for (const bool reflect : {true, false}) {
    const SafeTensors padded = with_padding(contents, reflect ? R"("reflect")" : R"("zero")");
    expect_equal(Network::load(file(padded)).features(image.unsqueeze(0))[0][0],
                 naive::convolved(input, contents, "a", true, reflect), 1e-5);
  }
  for (const char* bad : {"\"circular\"", "3", "null"})
    EXPECT_NE(user_error([&] { Network::load(file(with_padding(contents, bad))); }).find("padding"),
              std::string::npos)
        << bad;
}

TEST_F(NetworkTest, WhatLiesBehindTheLastTapIsNeitherReadNorRun) {
  SafeTensors contents = with_layers(R"([{"op": "conv", "weights": "a"}, {"op": "tap"}, {"op": "avg_pool"},
                                         {"op": "conv", "weights": "b"}, {"op": "conv", "weights": "none"}])");
  contents.tensors["b.bias"] = at::full({5}, std::numeric_limits<double>::quiet_NaN(), at::kFloat);
  const Network network = Network::load(file(contents));
  EXPECT_EQ(network.minimum_resolution(), 2) << "that of the first convolution";
  EXPECT_EQ(network.features(random_image(8).unsqueeze(0)).size(), 1u);
}

TEST_F(NetworkTest, FirstLevelsAloneAreTheSameAndTheOthersAreNotRead) {
  const std::filesystem::path whole = file(small_network());
  const at::Tensor image = random_image(20).unsqueeze(0);
  const std::vector<at::Tensor> all = Network::load(whole).features(image);
  ASSERT_EQ(all.size(), 3u);
  for (const int levels : {1, 2, 3}) {
    const std::vector<at::Tensor> some = Network::load(whole, Precision::float32, levels).features(image);
    ASSERT_EQ(std::ssize(some), levels);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_TRUE(some[i].equal(all[i])) << levels;
  }
  EXPECT_NE(user_error([&] { make_summary("gram4", whole); }).find("gram4 asks for more"), std::string::npos);
  SafeTensors damaged = small_network();
  damaged.tensors["b.bias"].fill_(std::numeric_limits<double>::quiet_NaN());
  const std::filesystem::path path = file(damaged);
  EXPECT_NE(user_error([&] { Network::load(path); }), "");
  EXPECT_EQ(levels_of(*make_summary("gram1+rings", path)), 1);
}

TEST_F(NetworkTest, TellsItsChannelsAndTheSmallestImageItTakes) {
  const Network network = Network::load(file(small_network()));
  EXPECT_EQ(network.feature_channels(), (std::vector<std::int64_t>{4, 2, 3}));
  ASSERT_EQ(network.minimum_resolution(), 6) << "5 x 5 filters after one pooling reflect 2 of 3 pixels";
  EXPECT_EQ(network.features(random_image(6).unsqueeze(0)).size(), 3u);
  EXPECT_ANY_THROW(network.features(random_image(5).unsqueeze(0)));
}

TEST(GramVector, EqualsLoopsOverThePixelsAndKeepsTheFrobeniusNorm) {
  const at::Tensor features = random_tensor({5, 7, 9}, 4);
  const std::vector<double> expected = naive::gram(naive::from_tensor(features));
  const at::Tensor vector = gram_vector(features.unsqueeze(0)).squeeze(0);
  ASSERT_EQ(vector.numel(), 15);
  std::int64_t k = 0;
  double square = 0;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      square += expected[i * 5 + j] * expected[i * 5 + j];
      if (j >= i) {
        EXPECT_NEAR(vector[k++].item<double>(), expected[i * 5 + j] * (i == j ? 1 : std::sqrt(2.0)), 1e-5);
      }
    }
  EXPECT_NEAR(vector.norm().item<double>(), std::sqrt(square), 1e-5);
}

TEST_F(NetworkTest, GradientEqualsCentralDifferencesWhichAreExactForAQuadraticSummary) {
  const auto smooth =
      make_summary("gram", file(with_layers(R"([{"op": "conv", "weights": "a", "relu": false}, {"op": "tap"},
                                   {"op": "avg_pool"}, {"op": "conv", "weights": "b", "relu": false},
                                   {"op": "tap"}])")));
  EXPECT_LT(gradient_error(*smooth, 16, 0.1), 1e-4);
}

TEST_F(NetworkTest, GradientPassesRectifiersAndMaxima) {
  const auto summary = make_summary("gram", file(small_network()));
  EXPECT_LT(gradient_error(*summary, 16, 3e-4), 1e-2) << "the error falls with the step: kinks";
}

/// A random linear functional of a vector, which every entry weighs on.
at::Tensor functional(const at::Tensor& vector) { return (vector * random_tensor(vector.sizes(), 8)).sum(); }

TEST_F(NetworkTest, SeveralImagesInOnePassHaveTheSummariesAndGradientsThatEachHasByItself) {
  const std::filesystem::path path = file(small_network());
  const at::Tensor images = at::stack({random_image(34, 3), random_image(34, 4), random_image(34, 5)});
  for (const char* name : {"gram", "covariances", "gram+covariances+rings+bands"}) {
    const auto summary = make_summary(name, path);
    const at::Tensor together = images.clone().set_requires_grad(true), rows = summary->of(together);
    (functional(rows[0]) + functional(rows[1]) + functional(rows[2])).backward();
    for (std::int64_t i = 0; i < images.size(0); ++i) {
      const at::Tensor alone = images[i].clone().set_requires_grad(true), row = (*summary)(alone);
      functional(row).backward();
      EXPECT_TRUE(rows[i].allclose(row, 1e-4, 1e-6)) << name << ", image " << i;
      EXPECT_LT((together.grad()[i] - alone.grad()).norm().item<double>(),
                1e-5 * alone.grad().norm().item<double>())
          << name << ", image " << i;
      EXPECT_FALSE(rows[i].allclose(rows[(i + 1) % 3], 1e-4, 1e-6)) << "the control: another image's";
    }
  }
}

TEST(GramVector, OfManyChannelsIsThatOfEachImageByItselfToo) {  // by a BLAS
  const at::Tensor features = random_tensor({2, 100, 5, 6}, 4);
  const at::Tensor rows = gram_vector(features);
  for (std::int64_t i = 0; i < 2; ++i)
    EXPECT_TRUE(rows[i].allclose(gram_vector(features.slice(0, i, i + 1))[0])) << i;
}

TEST_F(NetworkTest, SummaryIsItsBlocksInOrder) {
  const std::filesystem::path path = file(small_network());
  const auto summary = make_summary("gram", path);
  const at::Tensor image = random_image(20), vector = (*summary)(image);
  const std::vector<at::Tensor> features = Network::load(path).features(image.unsqueeze(0));
  std::int64_t at = 0;
  const std::vector<SummaryBlock> blocks = summary->blocks();
  ASSERT_EQ(blocks.size(), features.size() + 1);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool gram = i < features.size();
    const at::Tensor expected = gram ? gram_vector(features[i])[0] : RingMeans(4)(image);
    EXPECT_EQ(blocks[i].scale, gram ? ErrorScale::relative : ErrorScale::regional) << blocks[i].name;
    ASSERT_EQ(blocks[i].size, expected.numel()) << blocks[i].name;
    EXPECT_TRUE(vector.slice(0, at, at + blocks[i].size).allclose(expected)) << blocks[i].name;
    at += blocks[i].size;
  }
  EXPECT_EQ(at, vector.numel());
}

TEST_F(NetworkTest, RefusesDescriptionsThatDoNotFitItsTensors) {
  const auto said = [&](const std::string& layers) {
    return user_error([&] { Network::load(file(with_layers(layers))); });
  };
  EXPECT_EQ(said(R"([{"op": "tap"}])"), "") << "the control: this one is good";
  const std::pair<const char*, const char*> cases[] = {
      {R"([{"op": "conv", "weights": "z"}, {"op": "tap"}])", "'z.weight' is missing"},
      {R"([{"op": "conv", "weights": "b"}, {"op": "tap"}])", "takes 4 channels where 3 arrive"},
      {R"([{"op": "tap", "weights": ["a", "c"]}])", "takes 5 channels where 4 arrive"},
      {R"([{"op": "conv", "weights": "a", "relu": "yes"}, {"op": "tap"}])", "'relu'"},
      {R"([{"op": "conv", "weights": 3}, {"op": "tap"}])", "lacks 'weights'"},
      {R"([{"op": "conv"}, {"op": "tap"}])", "lacks 'weights'"},
      {R"([{"op": "tap", "weights": "a"}])", "not a list"},
      {R"([{"op": "tap", "weights": [1]}])", "not names"},
      {R"([{"op": "dropout"}, {"op": "tap"}])", "unknown layer 'dropout'"},
      {R"([{"op": "avg_pool"}])", "no tap"},
      {R"([7])", "lacks 'op'"},
      {R"([])", "no tap"},
      {R"("none")", "no list of layers"},
  };
  for (const auto& [layers, message] : cases)
    EXPECT_NE(said(layers).find(message), std::string::npos) << layers << ": " << said(layers);
  std::string pools;
  for (int i = 0; i < 9; ++i) pools += R"({"op": "avg_pool"}, )";
  EXPECT_NE(said("[" + pools + R"({"op": "tap"}])").find("more than 8"), std::string::npos);
}

TEST_F(NetworkTest, RefusesTensorsThatCannotBeConvolutions) {
  const auto said = [&](const std::string& name, const at::Tensor& tensor) {
    SafeTensors contents = small_network();
    contents.tensors[name] = tensor;
    return user_error([&] { Network::load(file(contents)); });
  };
  EXPECT_EQ(said("a.bias", random_tensor({4}, 1)), "") << "the control: this one is good";
  EXPECT_NE(said("a.bias", random_tensor({3}, 1)).find("bias"), std::string::npos);
  EXPECT_NE(said("a.bias", random_tensor({4, 1}, 1)).find("dimensions"), std::string::npos);
  EXPECT_NE(said("a.weight", random_tensor({4, 3, 2, 2}, 1)).find("odd square"), std::string::npos);
  EXPECT_NE(said("a.weight", random_tensor({4, 3, 3, 5}, 1)).find("odd square"), std::string::npos);
  EXPECT_NE(said("a.weight", random_tensor({4, 3, 67, 67}, 1)).find("odd square"), std::string::npos);
  EXPECT_NE(said("a.weight", random_tensor({3000, 3, 1, 1}, 1)).find("channels"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said("a.bias", at::full({4}, nan, at::kFloat)).find("not numbers"), std::string::npos);
}

TEST_F(NetworkTest, RefusesDescriptionsOfAnotherFormatOrWithoutUsableColours) {
  const auto said = [&](const std::string& description) {
    SafeTensors contents = small_network();
    contents.metadata["patina_network"] = description;
    return user_error([&] { Network::load(file(contents)); });
  };
  const std::string tail = R"(, "layers": [{"op": "tap"}]})";
  const std::string colours = R"("mean": [0, 0, 0], "std": [1, 1, 1])";
  EXPECT_EQ(said(R"({"format": 1, "name": "n", )" + colours + tail), "") << "the control: this one is good";
  for (const std::string& bad :
       {std::string("not JSON"), std::string("[]"), R"({"format": 2, "name": "n", )" + colours + tail,
        R"({"format": "1", "name": "n", )" + colours + tail, R"({"format": 1, "name": 5, )" + colours + tail,
        R"({"format": 1, "name": "n", "mean": [0, 0], "std": [1, 1, 1])" + tail,
        R"({"format": 1, "name": "n", "mean": [0, 0, "0"], "std": [1, 1, 1])" + tail,
        R"({"format": 1, "name": "n", "mean": [0, 0, 1e300], "std": [1, 1, 1])" + tail,
        R"({"format": 1, "name": "n", "mean": [0, 0, 0], "std": [1, 0, 1])" + tail,
        R"({"format": 1, "name": "n", "mean": [0, 0, 0], "std": [1, -1, 1])" + tail})
    EXPECT_NE(said(bad), "") << bad;
  SafeTensors bare = small_network();
  bare.metadata.clear();
  EXPECT_NE(user_error([&] { Network::load(file(bare)); }).find("do not describe a network"),
            std::string::npos);
}

TEST(SummaryNames, AreThoseThatCanBeMadeAndNoOthers) {
  for (const std::string& name : summary_names())
    EXPECT_NO_THROW(make_summary(name, bundled_network())) << name;
  EXPECT_NE(user_error([] { make_summary("colour", {}); }).find("'colour'"), std::string::npos);
}

}  // namespace
}  // namespace patina
