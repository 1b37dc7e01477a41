#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "gui/plot/chain_trace.h"

namespace patina {
namespace {

TEST(ChainTrace, KeepsOfEveryBucketWhatAnExhaustiveSearchFindsHoweverLongTheChainBecomes) {
  std::mt19937 rng(1);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  ChainTrace trace;
  for (const std::size_t length : {1u, 300u, 512u, 513u, 5000u, 70'001u}) {
    while (values.size() < length) {
      values.push_back(normal(rng));
      trace.add(static_cast<std::int64_t>(values.size()) - 1, values.back());
    }
    const auto steps = static_cast<std::size_t>(trace.steps_per_bucket());
    ASSERT_LE(trace.buckets().size(), ChainTrace::kMostBuckets);
    ASSERT_EQ(trace.buckets().size(), (values.size() + steps - 1) / steps);
    EXPECT_TRUE(steps == 1 || trace.buckets().size() > ChainTrace::kMostBuckets / 2)
        << "no coarser than need be";
    for (std::size_t i = 0; i < trace.buckets().size(); ++i) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i * steps);
      const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), (i + 1) * steps));
      const ChainTrace::Bucket& bucket = trace.buckets()[i];
      ASSERT_FALSE(bucket.empty);
      ASSERT_EQ(bucket.first, *begin);
      ASSERT_EQ(bucket.last, *(end - 1));
      ASSERT_EQ(bucket.low, *std::min_element(begin, end));
      ASSERT_EQ(bucket.high, *std::max_element(begin, end));
    }
  }
}

TEST(ChainTrace, LeavesGapsWhereStepsAreMissingAndValuesAreNotFinite) {
  ChainTrace trace;
  trace.add(0, 1);
  trace.add(1, std::nan(""));
  trace.add(5, 2);
  ASSERT_EQ(trace.buckets().size(), 6u);
  for (const std::size_t i : {1u, 2u, 3u, 4u}) EXPECT_TRUE(trace.buckets()[i].empty);
  trace.add(100'000, 3);
  EXPECT_EQ(trace.buckets().front().high, 2);
  EXPECT_EQ(trace.buckets().back().low, 3);
}

}  // namespace
}  // namespace patina
