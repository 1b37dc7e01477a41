#include <gtest/gtest.h>

#include "gui/explorer_model.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

Draw draw_of(int chain, std::int64_t iteration) {
  Draw draw = testing::draw_at(0.5, 0.5, -1, false, chain);
  draw.iteration = iteration;
  return draw;
}

TEST(Stars, BelongToDrawsThatArriveLater) {
  ExplorerModel model(testing::small_table());
  model.set_stars({{1, 2, "good"}, {0, 3, ""}});
  model.append(std::vector{draw_of(0, 2), draw_of(1, 1)});
  EXPECT_EQ(model.draw_of(model.stars()[0]), std::nullopt);
  model.append(std::vector{draw_of(1, 2), draw_of(0, 3), draw_of(1, 3)});
  EXPECT_EQ(model.draw_of(model.stars()[0]), 2u);
  EXPECT_EQ(model.draw_of(model.stars()[1]), 3u);
  EXPECT_TRUE(model.starred(2));
  EXPECT_FALSE(model.starred(0));
}

TEST(Stars, AreGivenOnceTakenAwayAndBroughtBackWithTheirNotes) {
  ExplorerModel model(testing::small_table());
  model.append(std::vector{draw_of(0, 0), draw_of(0, 1), draw_of(1, 0)});
  model.star(2, true);
  model.star(0, true);
  model.star(2, true);
  ASSERT_EQ(model.stars().size(), 2u);
  model.annotate(0, "darker");
  const ExplorerChoices before = model.choices();
  model.star(2, false);
  EXPECT_EQ(model.stars(), (std::vector<Star>{{0, 0, ""}}));
  model.restore(before);
  EXPECT_EQ(model.stars(), (std::vector<Star>{{1, 0, "darker"}, {0, 0, ""}}));
  EXPECT_EQ(model.draw_of(model.stars()[0]), 2u);
}

}  // namespace
}  // namespace patina
