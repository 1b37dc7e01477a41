#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "engine/error.h"
#include "engine/io/image_file.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/registry.h"
#include "gui/app.h"
#include "gui/window/offscreen_window.h"
#include "tests/gui/fake_source.h"

namespace patina::testing {

/// The real window's program on OSMesa, with runs of known draws of the material bump. Frames are real ones.
class AppTest : public ::testing::Test {
 protected:
  AppTest() {
    Image image(64, 64, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 0.4f);
    write_image(photo_, image);
    frames(2);
  }

  RunFactory factory() {
    RunFactory factory;
    factory.start = [this](const RunSettings& settings, const Photo& photo,
                           const std::filesystem::path& directory, auto) {
      return std::make_unique<FakeSource>(run_, settings, table_, photo.image, directory);
    };
    factory.resume = [this](const RunSettings& settings, const std::filesystem::path& directory, auto) {
      run_->status.phase = RunPhase::sampling;
      return std::make_unique<FakeSource>(run_, settings, table_, Image(64, 64, 3), directory);
    };
    factory.open = [this](const std::filesystem::path& directory, auto) -> std::unique_ptr<DrawSource> {
      if (!std::filesystem::exists(directory / "run.json"))
        throw UserError("There is no run in this directory; open another one.");
      return std::make_unique<FakeSource>(run_, RunSettings(), table_, Image(64, 64, 3), directory);
    };
    factory.rank = [this](auto&&...) { return ranking_; };
    return factory;
  }

  void frames(int count) {
    for (int i = 0; i < count; ++i) app_.frame(0);
  }

  /// Runs frames until all queued input has been taken and answered.
  void answer_input() {
    while (!window_->input_taken()) app_.frame(0);
    frames(3);
  }

  /// Runs frames until something holds. @return whether it did within two minutes
  bool frames_until(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!holds() && std::chrono::steady_clock::now() < end) app_.frame(0.02);
    return holds();
  }

  /// A draw of bump at given roughness and albedo, the rest typical.
  Draw draw(double rough, double albedo, double lp, int chain = 0) const {
    Draw draw;
    draw.chain = chain;
    draw.lp = lp;
    draw.values = prior_location(table_);
    draw.values.continuous[*table_.find_continuous("rough")] = rough;
    draw.values.continuous[*table_.find_continuous("albedo_r")] = albedo;
    return draw;
  }

  PlotAxis axis(const char* name) const {
    return {PlotAxis::Kind::continuous, *table_.find_continuous(name)};
  }

  /// Opens the photo, starts a run of these draws, and plots them by roughness and albedo.
  void start_run_of(const std::vector<Draw>& draws) {
    app_.load(photo_);
    app_.session().start();
    run_->status.phase = RunPhase::sampling;
    run_->feed(draws);
    app_.session().model().set_axes(axis("rough"), axis("albedo_r"));
    frames(3);
  }

  /// Where a draw is on the screen.
  ImVec2 pixel_of(std::size_t index) const {
    const ExplorerModel& model = app_.session().model();
    const PlotView& view = app_.scatter().view();
    return {view.pixel_of_x(model.draws().place(model.x_axis(), index)),
            view.pixel_of_y(model.draws().place(model.y_axis(), index))};
  }

  void click(ImVec2 at) {
    window_->click(at.x, at.y);
    answer_input();
  }

  /// Taps a key. @param key  an ASCII capital or digit, or ImGui::GetKeyIndex() of a named one
  void press(int key, ImGuiKeyModFlags modifiers = ImGuiKeyModFlags_None) {
    window_->hold_modifiers(modifiers);
    window_->tap_key(key);
    window_->hold_modifiers(ImGuiKeyModFlags_None);
    answer_input();
  }

  TemporaryFolder folder_;
  std::filesystem::path photo_ = folder_.path() / "oak.png";
  std::shared_ptr<FakeRun> run_ = std::make_shared<FakeRun>();
  std::optional<MaterialRanking> ranking_;  ///< what a search for the material comes to
  ParameterTable table_ = material_table("bump");
  std::unique_ptr<OffscreenWindow> window_ = OffscreenWindow::make(1280, 800);
  App app_{*window_, factory(), folder_.path() / "runs"};
};

/// What a screenshot shows in a rectangle of the window.
inline Image part_of(const Image& screenshot, const Rect& rect) {
  const int left = static_cast<int>(rect.position.x), top = static_cast<int>(rect.position.y);
  Image part(static_cast<int>(rect.size.x), static_cast<int>(rect.size.y), screenshot.channels);
  for (int row = 0; row < part.height; ++row)
    for (int column = 0; column < part.width; ++column)
      for (int c = 0; c < part.channels; ++c)
        part.at(row, column, c) = screenshot.at(top + row, left + column, c);
  return part;
}

/// The mean absolute difference of two images of one size.
inline double mean_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.pixels.size());
}

}  // namespace patina::testing
