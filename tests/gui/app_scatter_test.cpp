#include <thread>

#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppScatter : public AppTest {};

std::vector<ImVec2> corners_and_middle() {
  return {{0.25f, 0.2f}, {0.55f, 0.2f}, {0.25f, 0.8f}, {0.55f, 0.8f}, {0.4f, 0.5f}};
}

TEST_F(AppScatter, AClickOnADrawsPixelSelectsExactlyThatDraw) {
  std::vector<Draw> draws;
  for (const ImVec2& place : corners_and_middle()) draws.push_back(draw(place.x, place.y, -1));
  start_run_of(draws);
  for (const std::size_t index : {3u, 0u, 4u, 2u, 1u}) {
    click(pixel_of(index));
    EXPECT_EQ(app_.session().model().selected(), index);
  }
}

TEST_F(AppScatter, AClickFarFromEveryDrawLeavesTheSelectionAlone) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1)});
  click(pixel_of(1));
  const PlotView& view = app_.scatter().view();
  click({view.left + 0.9f * view.width, view.top + 0.9f * view.height});
  EXPECT_EQ(app_.session().model().selected(), 1u);
}

TEST_F(AppScatter, ADrawLightsThePixelsWhereItIsClicked) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -2, 1), draw(0.4, 0.5, -1.5, 2)});
  const ImVec2 at = pixel_of(1);
  const Image image = window_->screenshot();
  float strongest = 0;
  for (int channel = 0; channel < 3; ++channel) {
    strongest = std::max(strongest, image.at(static_cast<int>(at.y), static_cast<int>(at.x), channel));
  }
  EXPECT_GT(strongest, 0.5f);
}

TEST_F(AppScatter, DrawsThatArriveWhileFramesRunAllLandInTheModel) {
  start_run_of({});
  constexpr int kChains = 3, kDraws = 2000;
  {
    std::vector<std::jthread> chains;
    for (int chain = 0; chain < kChains; ++chain) {
      chains.emplace_back([this, chain] {
        for (int i = 0; i < kDraws; ++i) {
          Draw next = draw(0.25 + 0.3 * i / kDraws, 0.5, -i, chain);
          next.iteration = i;
          run_->queue.push(next);
        }
      });
    }
    frames(20);
  }
  frames(1);
  const DrawColumns& columns = app_.session().model().draws();
  ASSERT_EQ(columns.size(), static_cast<std::size_t>(kChains * kDraws));
  std::vector<std::int64_t> next(kChains, 0);
  for (std::size_t i = 0; i < columns.size(); ++i) EXPECT_EQ(columns.iteration(i), next[columns.chain(i)]++);
}

TEST_F(AppScatter, TheWheelZoomsAboutThePointerTheRightButtonMovesAndADoubleClickShowsAllAgain) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1), draw(0.4, 0.5, -1)});
  const PlotView before = app_.scatter().view();
  const ImVec2 at = pixel_of(2);
  window_->move_mouse(at.x, at.y);
  window_->scroll(0, 4);
  answer_input();
  const PlotView zoomed = app_.scatter().view();
  EXPECT_NEAR(zoomed.x.span() / before.x.span(), std::pow(0.85, 4), 1e-6);
  EXPECT_NEAR(pixel_of(2).x, at.x, 0.5);
  EXPECT_NEAR(pixel_of(2).y, at.y, 0.5);

  window_->drag(at.x, at.y, at.x + 40, at.y - 30, ImGuiMouseButton_Right);
  answer_input();
  EXPECT_NEAR(pixel_of(2).x, at.x + 40, 0.5);
  EXPECT_NEAR(pixel_of(2).y, at.y - 30, 0.5);
  click(pixel_of(2));
  EXPECT_EQ(app_.session().model().selected(), 2u);

  window_->double_click(at.x, at.y);
  answer_input();
  EXPECT_NEAR(app_.scatter().view().x.low, before.x.low, 1e-9);
  EXPECT_NEAR(app_.scatter().view().y.high, before.y.high, 1e-9);
}

TEST_F(AppScatter, OtherAxesShowTheSameDrawsElsewhereAndTheyCanStillBeHit) {
  std::vector<Draw> draws;
  for (int i = 0; i < 5; ++i) draws.push_back(draw(0.25 + 0.05 * i, 0.5, -i));
  start_run_of(draws);
  app_.session().model().set_axes(axis("rough"), {PlotAxis::Kind::log_posterior, 0});
  frames(2);
  click(pixel_of(3));
  EXPECT_EQ(app_.session().model().selected(), 3u);
}

TEST_F(AppScatter, AHundredThousandDrawsAreShownAndCanBeSelected) {
  std::vector<Draw> draws;
  for (int i = 0; i < 100'000; ++i) {
    draws.push_back(draw(0.3 + 0.1 * std::sin(0.37 * i), 0.5 + 0.2 * std::cos(0.11 * i), -1e-4 * i, i % 4));
    draws.back().iteration = i / 4;
  }
  draws.push_back(draw(0.6, 0.95, -1));
  start_run_of(draws);
  frames(5);
  EXPECT_EQ(app_.session().model().draws().size(), draws.size());
  click(pixel_of(100'000));
  EXPECT_EQ(app_.session().model().selected(), 100'000u);
}

}  // namespace
}  // namespace patina::testing
