#include "engine/sampling/rng.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "engine/sampling/philox.h"
#include "tests/sampling/statistics.h"

namespace patina {
namespace {

using testing_statistics::dkw_bound;
using testing_statistics::ks_distance;
using testing_statistics::normal_cdf;
using Words = std::array<std::uint32_t, 4>;

// Known answers published with the Random123 library (kat_vectors, philox4x32, 10 rounds).
TEST(Philox, gives_the_known_answers_of_its_authors) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Rng, hands_out_the_blocks_of_its_stream_in_order) {
  Rng rng(0x1122334455667788, 0x99aabbccddeeff00);
  for (std::uint32_t block = 0; block < 3; ++block) {
    const Words expected = philox4x32({block, 0, 0xddeeff00, 0x99aabbcc}, {0x55667788, 0x11223344});
    for (const std::uint32_t word : expected) EXPECT_EQ(rng(), word);
  }
}

TEST(Rng, goes_on_exactly_from_any_position_it_is_sent_to) {
  for (const int taken : {0, 1, 3, 4, 5, 1000}) {
    Rng uninterrupted(7, 3);
    for (int i = 0; i < taken; ++i) uninterrupted();
    Rng resumed(7, 3);
    resumed.seek(uninterrupted.position());
    for (int i = 0; i < 20; ++i) ASSERT_EQ(resumed.normal(), uninterrupted.normal()) << "after " << taken;
    EXPECT_EQ(resumed.position(), uninterrupted.position());
  }
}

TEST(Rng, streams_and_seeds_differ) {
  EXPECT_NE(Rng(1, 0)(), Rng(1, 1)());
  EXPECT_NE(Rng(1, 0)(), Rng(2, 0)());
}

TEST(Rng, uniforms_are_uniform_and_inside_the_open_interval) {
  Rng rng(11);
  std::vector<double> sample(200000);
  for (double& value : sample) {
    value = rng.uniform();
    ASSERT_GT(value, 0);
    ASSERT_LT(value, 1);
  }
  EXPECT_LT(ks_distance(sample, [](double x) { return x; }), dkw_bound(sample.size(), 1e-6));
}

TEST(Rng, normals_have_the_normal_distribution_and_its_moments) {
  Rng rng(12);
  const Eigen::ArrayXd z = rng.normals(400000);
  const std::vector<double> sample(z.begin(), z.end());
  EXPECT_LT(ks_distance(sample, normal_cdf), dkw_bound(sample.size(), 1e-6));
  const double n = static_cast<double>(z.size());
  // Variances of z, z^2, z^3, z^4 under N(0, 1): 1, 2, 15, 96.
  EXPECT_LT(std::abs(z.mean()), 5 * std::sqrt(1 / n));
  EXPECT_LT(std::abs(z.square().mean() - 1), 5 * std::sqrt(2 / n));
  EXPECT_LT(std::abs(z.cube().mean()), 5 * std::sqrt(15 / n));
  EXPECT_LT(std::abs(z.square().square().mean() - 3), 5 * std::sqrt(96 / n));
  EXPECT_LT(std::abs((z.head(z.size() - 1) * z.tail(z.size() - 1)).mean()), 5 * std::sqrt(1 / n));
}

TEST(Rng, integers_below_a_number_are_equally_likely) {
  Rng rng(13);
  for (const int n : {1, 2, 7, 12}) {
    std::vector<int> counts(n);
    const int draws = 60000;
    for (int i = 0; i < draws; ++i) ++counts.at(rng.below(n));
    const double p = 1.0 / n;
    for (const int count : counts) EXPECT_LE(std::abs(count - draws * p), 5 * std::sqrt(draws * p * (1 - p)));
  }
}

// 2^32 words do not divide evenly among 3 * 2^29 integers: taken as they come, every third would be a quarter
// rarer.
TEST(Rng, integers_below_a_large_number_are_equally_likely) {
  Rng rng(14);
  constexpr int draws = 60000;
  std::array<int, 3> counts{};
  for (int i = 0; i < draws; ++i) ++counts[rng.below(3 << 29) % 3];
  for (const int count : counts) EXPECT_LE(std::abs(count - draws / 3), 5 * std::sqrt(draws * 2.0 / 9));
}

}  // namespace
}  // namespace patina
