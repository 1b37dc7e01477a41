// The parts by which a network is trained and judged (resources/networks).
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/stack.h>

#include <cmath>
#include <set>

#include "engine/summary/gram.h"
#include "resources/networks/gram_distance.h"
#include "resources/networks/held_out.h"
#include "resources/networks/image_variants.h"
#include "resources/networks/student.h"
#include "resources/networks/training.h"
#include "tests/summary/gradients.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

constexpr std::int64_t kTrainingSide = 32;

/// Noise images that differ in grain, contrast and colour.
std::vector<at::Tensor> images(int count) {
  std::vector<at::Tensor> images;
  Rng rng(1);
  for (int i = 0; i < count; ++i) {
    at::Tensor image = random_image(kTrainingSide, static_cast<unsigned>(i));
    for (int k = 0; k < 3; ++k)
      image = vary(image, random_image(kTrainingSide, static_cast<unsigned>(100 + k)), rng);
    images.push_back(image);
  }
  return images;
}

class NetworkTraining : public NetworkFiles {
 protected:
  Network small_teacher() const { return Network::load(file(small_network())); }
};

TEST_F(NetworkTraining, AStudentsFileComputesWhatTheStudentDoesBalancedOrNot) {
  const at::NoGradGuard no_grad;
  const std::vector<at::Tensor> some = images(3);
  Student student({{4}, {6, 5}, {3}}, at::stack(some), 1);
  for (const bool balanced : {false, true}) {
    if (balanced) student.balance(at::stack(some));
    const GramMatrices gram(Network::load(file(student.to_file("s"))));
    ASSERT_EQ(gram.blocks().size(), 3u);
    const at::Tensor mine = gram(some[0]);
    const std::vector<at::Tensor> expected = student.grams(at::stack(some));
    std::int64_t begin = 0;
    double norms = 0;
    for (std::size_t tap = 0; tap < expected.size(); ++tap) {
      const std::int64_t size = gram.blocks()[tap].size;
      EXPECT_NEAR(mine.narrow(0, begin, size).norm().item<double>() / expected[tap][0].norm().item<double>(),
                  1, 1e-5);
      begin += size;
      for (int i = 0; i < 3; ++i) norms += expected[tap][i].norm().item<double>() / 9;
    }
    if (balanced) {
      EXPECT_NEAR(norms, 1, 1e-4);
    }
    const Student again(read_safetensors(file(student.to_file("s"))));
    EXPECT_TRUE(again.grams(some[1].unsqueeze(0))[2].equal(student.grams(some[1].unsqueeze(0))[2]));
  }
}

TEST_F(NetworkTraining, RevivesDeadChannelsAndLeavesTheOthersAsTheyAre) {
  const at::NoGradGuard no_grad;
  const at::Tensor some = at::stack(images(3));
  const Student before({{4}, {6, 5}, {3}}, some, 1);
  SafeTensors dying = before.to_file("s");
  dying.tensors.at("level2.1.bias")[2] = -100;
  dying.tensors.at("level2.2.bias")[4] = -100;
  Student student(dying);
  const std::vector<at::Tensor> with_dead = student.grams(some);
  EXPECT_EQ(with_dead[1].view({3, 5, 5}).select(1, 4).abs().max().item<float>(), 0);
  EXPECT_EQ(student.revive(some, 1), 2);
  const std::vector<at::Tensor> after = student.grams(some);
  EXPECT_GT(after[1].view({3, 5, 5}).select(1, 4).select(1, 4).min().item<float>(), 0);
  const auto living = [](const at::Tensor& grams) {
    return grams.view({3, 5, 5}).narrow(1, 0, 4).narrow(2, 0, 4);
  };
  EXPECT_TRUE(living(after[1]).allclose(living(with_dead[1]))) << "nothing reads a new channel yet";
  EXPECT_TRUE(after[2].allclose(with_dead[2]));
  EXPECT_EQ(student.revive(some, 1), 0);
}

TEST_F(NetworkTraining, ASetsDistancesAreGramDistances) {
  const Network teacher = small_teacher();
  const std::vector<at::Tensor> some = images(4);
  const TrainingSet set = make_training_set(some, teacher);
  const GramMatrices gram(teacher);
  const auto rounded = [&](int i) { return gram(to_unit(set.images[i])); };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      EXPECT_NEAR(set.distances.mean(0)[i][j].item<double>(),
                  gram_distance(rounded(i), rounded(j), gram.blocks()), 1e-3);
  save(set, folder_ / "set.pt");
  const TrainingSet read = load_training_set(folder_ / "set.pt");
  EXPECT_TRUE(read.images.equal(set.images) && read.distances.equal(set.distances));
}

TEST_F(NetworkTraining, AStudentLearnsATeachersRanksOnImagesThatItWasNotTaught) {
  const TrainingSet set = make_training_set(images(96), small_teacher());
  Student student({{8}, {8}, {8}}, to_unit(set.images), 1);
  std::vector<std::int64_t> held_back;
  for (std::int64_t i = 4; i < 96; i += 8) held_back.push_back(i);
  const double before = rank_correlation(student, set, held_back);
  TrainingReport last;
  train(student, {set}, {.steps = 150, .batch = 24, .report_every = 50},
        [&](const TrainingReport& r) { last = r; });
  EXPECT_EQ(last.step, 150);
  EXPECT_DOUBLE_EQ(last.rank_correlation.at(0), rank_correlation(student, set, held_back));
  EXPECT_GT(last.rank_correlation[0], 0.9);
  EXPECT_GT(last.rank_correlation[0], before);
}

TEST(HeldOutPairs, AreDistinctAndHalfOfThemOfOneMaterial) {
  std::vector<std::string> materials;
  for (int i = 0; i < 30; ++i) materials.push_back(i % 3 == 0 ? "a" : i % 3 == 1 ? "b" : "c");
  const std::vector<Pair> pairs = held_out_pairs(materials, 200, 1);
  EXPECT_EQ(pairs.size(), 200u);
  EXPECT_EQ(std::set<Pair>(pairs.begin(), pairs.end()).size(), 200u);
  int alike = 0;
  for (const auto& [i, j] : pairs) {
    EXPECT_LT(j, i);
    alike += materials[i] == materials[j];
  }
  EXPECT_GE(alike, 100);
  EXPECT_LT(alike, 130);
  EXPECT_EQ(held_out_pairs(materials, 200, 1), pairs);
  EXPECT_NE(held_out_pairs(materials, 200, 2), pairs);
  EXPECT_EQ(held_out_pairs(materials, 10'000, 1).size(), 30u * 29 / 2) << "all there are";
}

TEST(BootstrapError, OfAMeanOverImagesIsItsStandardError) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < 100; ++i)
    for (std::size_t j = 0; j < i; ++j) pairs.emplace_back(i, j);
  const auto mean = [&](const std::vector<std::size_t>& chosen) {
    double sum = 0;
    for (const std::size_t p : chosen) sum += static_cast<double>(pairs[p].first + pairs[p].second);
    return sum / static_cast<double>(chosen.size());
  };
  // The mean of i + j over pairs is about twice that of i over 100 images, whose variance is (100^2 - 1)
  // / 12.
  EXPECT_NEAR(bootstrap_error(pairs, 100, mean), 2 * std::sqrt((1e4 - 1) / 12 / 100), 0.6);
}

TEST(ImageVariants, StayImagesAndDiffer) {
  Rng rng(3);
  const at::Tensor image = random_image(64), other = random_image(64, 9);
  double changed = 0;
  for (int i = 0; i < 40; ++i) {
    const at::Tensor varied = vary(image, other, rng);
    ASSERT_EQ(varied.sizes(), image.sizes());
    EXPECT_GE(varied.min().item<double>(), 0);
    EXPECT_LE(varied.max().item<double>(), 1);
    EXPECT_TRUE(varied.isfinite().all().item<bool>());
    changed += (varied - image).abs().mean().item<double>() > 1e-3;
  }
  EXPECT_GT(changed, 35);
}

}  // namespace
}  // namespace patina
