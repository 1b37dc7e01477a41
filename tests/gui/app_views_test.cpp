#include <random>

#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

/// All pairs and the trace, beside the one plot.
class AppViews : public AppTest {
 protected:
  const ExplorerModel& model() const { return app_.session().model(); }
  const MatrixPlot& matrix() const { return app_.scatter().matrix(); }

  std::size_t index_of(const PlotAxis& axis) const {
    const auto axes = plot_axes(table_);
    return static_cast<std::size_t>(std::ranges::find(axes, axis) - axes.begin());
  }

  /// Where a draw lies in the cell of roughness (upwards) over base colour red, or the like.
  ImVec2 pixel_in_cell(std::size_t row, std::size_t column, std::size_t draw) const {
    const auto axes = plot_axes(table_);
    const PlotView view = matrix().cell_view(row, column);
    return {view.pixel_of_x(model().draws().place(axes[column], draw)),
            view.pixel_of_y(model().draws().place(axes[row], draw))};
  }

  void start_grid() {
    std::vector<Draw> draws;
    for (int i = 0; i < 25; ++i) {
      draws.push_back(draw(0.2 + 0.1 * (i % 5), 0.1 + 0.2 * (i / 5), -i));
      draws.back().iteration = i;
    }
    start_run_of(draws);
  }
};

TEST_F(AppViews, AClickOnACellOpensItsPairLarge) {
  start_grid();
  press('A');
  ASSERT_EQ(app_.scatter().shown(), ScatterPanel::Show::pairs);
  const std::size_t rough = index_of(axis("rough")), red = index_of(axis("albedo_r"));
  const PlotView cell = matrix().cell_view(std::max(rough, red), std::min(rough, red));
  click({cell.left + 0.5f * cell.width, cell.top + 0.5f * cell.height});
  EXPECT_EQ(app_.scatter().shown(), ScatterPanel::Show::plot);
  EXPECT_EQ(model().y_axis(), plot_axes(table_)[std::max(rough, red)]);
  EXPECT_EQ(model().x_axis(), plot_axes(table_)[std::min(rough, red)]);
}

TEST_F(AppViews, ABoxInACellMarksItsDrawsAndAllCellsShowIt) {
  start_grid();
  press('A');
  frames(3);
  const std::size_t rough = index_of(axis("rough")), red = index_of(axis("albedo_r"));
  const std::size_t row = std::max(rough, red), column = std::min(rough, red);
  const ImVec2 a = pixel_in_cell(row, column, 6), b = pixel_in_cell(row, column, 12);
  const Image before = window_->screenshot();
  const ImVec2 low{std::min(a.x, b.x) - 3, std::min(a.y, b.y) - 3},
      high{std::max(a.x, b.x) + 3, std::max(a.y, b.y) + 3};
  window_->drag(low.x, low.y, high.x, high.y);
  answer_input();
  frames(3);
  std::vector<std::size_t> marked;
  for (std::size_t i = 0; i < 25; ++i) {
    if (model().marked().contains(i)) marked.push_back(i);
  }
  EXPECT_EQ(marked, (std::vector<std::size_t>{6, 7, 11, 12}));
  EXPECT_EQ(app_.scatter().shown(), ScatterPanel::Show::pairs) << "a drag is no click";
  const Image after = window_->screenshot();
  const PlotView other = matrix().cell_view(table_.continuous.size(), red);  // the match over base colour red
  double changed = 0;
  for (int y = static_cast<int>(other.top); y < static_cast<int>(other.top + other.height); ++y) {
    for (int x = static_cast<int>(other.left); x < static_cast<int>(other.left + other.width); ++x)
      changed += std::abs(after.at(y, x, 1) - before.at(y, x, 1));
  }
  EXPECT_GT(changed, 1) << "the other cells show which are marked";
}

TEST_F(AppViews, EveryPairOfAHundredThousandDrawsIsCountedWithinAFewFramesEachShort) {
  std::mt19937 rng(1);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int i = 0; i < 100'000; ++i)
    draws.push_back(draw(0.4 + 0.02 * normal(rng), 0.5 + 0.1 * normal(rng), -1, i % 4));
  start_run_of(draws);
  press('A');
  ASSERT_TRUE(frames_until([&] { return !app_.scatter().busy(); }));
  const Rect panel = lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()).scatter;
  const Image done = part_of(window_->screenshot(), panel);
  frames(3);
  EXPECT_EQ(mean_difference(done, part_of(window_->screenshot(), panel)), 0) << "nothing more to come";
}

TEST_F(AppViews, AllPairsScrollWhereTheyDoNotFit) {
  start_grid();
  window_->resize(640, 480);
  press('A');
  frames(3);
  const PlotView before = matrix().cell_view(1, 0);
  const Rect panel = lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()).scatter;
  window_->move_mouse(panel.position.x + 0.5f * panel.size.x, panel.position.y + 0.5f * panel.size.y);
  window_->scroll(0, -3);
  answer_input();
  frames(3);
  EXPECT_LT(matrix().cell_view(1, 0).top, before.top);
  EXPECT_EQ(matrix().cell_view(1, 0).width, before.width);
}

TEST_F(AppViews, TheTraceShowsDrawsByTheirStepAndAClickSelectsOne) {
  start_grid();
  press('T');
  ASSERT_EQ(app_.scatter().shown(), ScatterPanel::Show::trace);
  const PlotView& view = app_.scatter().trace().plot().view();
  const DrawColumns& draws = model().draws();
  for (const std::size_t index : {3u, 17u}) {
    click({view.pixel_of_x(static_cast<double>(draws.iteration(index))),
           view.pixel_of_y(draws.place(model().y_axis(), index))});
    EXPECT_EQ(model().selected(), index);
  }
}

TEST_F(AppViews, TheTraceShadesWarmup) {
  std::vector<Draw> draws;
  for (int i = 0; i < 100; ++i) {
    draws.push_back(draw(0.4, i % 2 == 0 ? 0.1 : 0.9, -1));
    draws.back().iteration = i;
    draws.back().warmup = i < 50;
  }
  start_run_of(draws);
  press('T');
  const PlotView& view = app_.scatter().trace().plot().view();
  const Image image = window_->screenshot();
  const auto brightness = [&](double step) {
    return image.at(static_cast<int>(view.pixel_of_y(0.47)), static_cast<int>(view.pixel_of_x(step)), 0);
  };
  const auto mean = [&](int from, int to) {
    double sum = 0;
    for (int step = from; step < to; ++step) sum += brightness(step + 0.5);
    return sum / (to - from);
  };
  EXPECT_GT(mean(5, 45), mean(55, 95) + 0.02);
}

}  // namespace
}  // namespace patina::testing
