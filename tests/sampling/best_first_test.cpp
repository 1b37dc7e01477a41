#include "engine/sampling/best_first.h"

#include <gtest/gtest.h>

#include "engine/sampling/chain_state.h"

namespace patina {
namespace {

TEST(AsGood, are_the_best_and_those_a_few_nats_behind) {
  const auto behind = [](double nats) { return ChainState{{}, {-20 - nats, {}}}; };
  const auto count = [](const std::vector<ChainState>& states) { return as_good(states); };
  EXPECT_EQ(count({behind(0)}), 1u);
  EXPECT_EQ(count({behind(0), behind(2), behind(6), behind(9)}), 3u);
  EXPECT_EQ(count({behind(0), behind(30)}), 1u);
  EXPECT_EQ(as_good(std::vector{behind(0), behind(2), behind(6), behind(9)}, 10), 4u);
}

}  // namespace
}  // namespace patina
