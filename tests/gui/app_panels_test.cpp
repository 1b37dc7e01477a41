#include <cmath>
#include <fstream>

#include "engine/io/file.h"
#include "gui/window/layout.h"
#include "gui/window/theme.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppPanels : public AppTest {
 protected:
  /// A point of the row of buttons at the foot of a panel; across from 0 to 1.
  ImVec2 foot(const Rect& panel, float across) const {
    const ImGuiStyle& style = ImGui::GetStyle();
    return {panel.position.x + style.WindowPadding.x + across * (panel.size.x - 2 * style.WindowPadding.x),
            panel.position.y + panel.size.y - style.WindowPadding.y - 0.5f * ImGui::GetFrameHeight()};
  }
  Layout layout() const { return lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()); }

  void type(const std::string& text) {
    window_->type(text);
    answer_input();
    press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  }
  void drop(const std::filesystem::path& file) {
    window_->drop_files({file});
    answer_input();
    ASSERT_TRUE(frames_until([&] { return !app_.loading(); }));
    frames(2);
  }
};

TEST_F(AppPanels, PauseResumeAndStopReachTheRun) {
  start_run_of({draw(0.4, 0.5, -1)});
  click(foot(layout().chains, 0.25f));
  EXPECT_EQ(run_->pauses, 1);
  click(foot(layout().chains, 0.25f));
  EXPECT_EQ(run_->resumes, 1);
  click(foot(layout().chains, 0.55f));
  EXPECT_EQ(run_->stops, 1);
  EXPECT_TRUE(app_.session().can_go_on());
  click(foot(layout().chains, 0.55f));
  EXPECT_EQ(run_->stops, 1) << "a run that has ended cannot be stopped again";
  EXPECT_EQ(app_.session().status().phase, RunPhase::sampling) << "it was continued";
}

TEST_F(AppPanels, ARunThatIsStillBeingReadSaysHowFarAndCanBeClosed) {
  std::filesystem::create_directories(folder_.path() / "run");
  std::ofstream(folder_.path() / "run" / "run.json") << "{}";
  run_->status.phase = RunPhase::finished;
  app_.load(folder_.path() / "run");
  const auto panel = [&](double read) {
    run_->status.read_fraction = read;
    frames(3);
    return part_of(window_->screenshot(), layout().chains);
  };
  const Image early = panel(0.3), late = panel(0.6), done = panel(1);
  EXPECT_GT(mean_difference(early, late), 1e-4) << "the bar grows";
  EXPECT_GT(mean_difference(late, done), 1e-3) << "then comes what is known of the chains";
  panel(0.3);
  click(foot(layout().chains, 0.5f));
  EXPECT_FALSE(app_.session().has_run());
  EXPECT_TRUE(app_.session().has_photo());
}

TEST_F(AppPanels, WhatDrawsCostIsShownInABoxUntilEsc) {
  start_run_of({draw(0.4, 0.5, -1)});
  click(foot(layout().chains, 0.97f));
  EXPECT_TRUE(app_.costs().visible());
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_FALSE(app_.costs().visible());
}

TEST_F(AppPanels, WhatARunSaysAgainstItselfStandsWithItsChainsInTheColourOfWarnings) {
  start_run_of({draw(0.4, 0.5, -1)});
  const auto warning_pixels = [&] {
    frames(3);
    const Image panel = part_of(window_->screenshot(), layout().chains);
    const ImVec4 warning = ImGui::ColorConvertU32ToFloat4(theme::kWarning);
    int count = 0;
    for (int row = 0; row < panel.height; ++row)
      for (int column = 0; column < panel.width; ++column)
        count += std::abs(panel.at(row, column, 0) - warning.x) +
                     std::abs(panel.at(row, column, 1) - warning.y) +
                     std::abs(panel.at(row, column, 2) - warning.z) <
                 0.1F;
    return count;
  };
  EXPECT_EQ(warning_pixels(), 0);
  run_->status.alarms = {{"dark", "The photo is almost black: expose it longer."}};
  EXPECT_GT(warning_pixels(), 50);
}

TEST_F(AppPanels, SpacePausesAndResumes) {
  start_run_of({draw(0.4, 0.5, -1)});
  press(ImGui::GetKeyIndex(ImGuiKey_Space));
  EXPECT_EQ(run_->pauses, 1);
  press(ImGui::GetKeyIndex(ImGuiKey_Space));
  EXPECT_EQ(run_->resumes, 1);
}

TEST_F(AppPanels, ArrowsWalkTheDrawsByLp) {
  start_run_of({draw(0.3, 0.5, -2), draw(0.4, 0.5, -1), draw(0.5, 0.5, -3)});
  std::vector<std::size_t> walked;
  for (int i = 0; i < 3; ++i) {
    press(ImGui::GetKeyIndex(ImGuiKey_RightArrow));
    walked.push_back(app_.session().model().selected().value());
  }
  EXPECT_EQ(walked, (std::vector<std::size_t>{1, 0, 2}));
  press(ImGui::GetKeyIndex(ImGuiKey_LeftArrow));
  EXPECT_EQ(app_.session().model().selected(), 0u);
}

TEST_F(AppPanels, ADroppedPhotoIsOpenedAndARunDirectoryToo) {
  drop(photo_);
  EXPECT_TRUE(app_.session().has_photo());
  EXPECT_FALSE(app_.session().has_run());
  std::ofstream(folder_.path() / "run.json") << "{}";
  drop(folder_.path());
  EXPECT_TRUE(app_.session().has_run());
  EXPECT_EQ(app_.session().run().directory(), folder_.path());
}

TEST_F(AppPanels, ADroppedFileThatIsNoPhotoShowsASentenceAndChangesNothing) {
  start_run_of({draw(0.4, 0.5, -1), draw(0.5, 0.6, -2)});
  app_.session().model().select(1);
  std::ofstream(folder_.path() / "notes.jpg") << "not a picture";
  const Image before = window_->screenshot();
  drop(folder_.path() / "notes.jpg");
  ASSERT_TRUE(app_.banner().visible());
  EXPECT_NE(app_.banner().sentence().find("notes.jpg"), std::string::npos) << app_.banner().sentence();
  EXPECT_GT(mean_difference(before, window_->screenshot()), 1e-4) << "the sentence is on the screen";
  EXPECT_TRUE(app_.session().has_run());
  EXPECT_EQ(app_.session().model().selected(), 1u);
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_FALSE(app_.banner().visible());
  EXPECT_EQ(app_.session().model().selected(), 1u) << "Esc dismissed the sentence only";
}

TEST_F(AppPanels, APathTypedIntoTheFileDialogIsOpened) {
  press('O', ImGuiKeyModFlags_Ctrl);
  ASSERT_TRUE(app_.dialog().visible());
  type((folder_.path() / "nothing.png").string());
  EXPECT_TRUE(app_.dialog().visible()) << "a wrong path keeps the dialog open";
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_FALSE(app_.dialog().visible());
  press('O', ImGuiKeyModFlags_Ctrl);
  type(folder_.path().string());
  EXPECT_EQ(app_.dialog().folder(), folder_.path()) << "a folder is entered";
  type("oak.png");
  EXPECT_FALSE(app_.dialog().visible());
  EXPECT_TRUE(frames_until([&] { return app_.session().has_photo(); }));
}

TEST_F(AppPanels, ExportWritesTheSelectedDrawsFiles) {
  start_run_of({draw(0.4, 0.5, -1), draw(0.5, 0.6, -2)});
  app_.session().model().select(1);
  press('E', ImGuiKeyModFlags_Ctrl);
  ASSERT_TRUE(app_.dialog().visible());
  press('A', ImGuiKeyModFlags_Ctrl);
  const auto target = folder_.path() / "taken" / "away";
  type(target.string());
  ASSERT_TRUE(frames_until([&] { return !app_.exporting(); }));
  EXPECT_FALSE(app_.banner().visible()) << app_.banner().sentence();
  for (const char* name :
       {"params.json", "render.png", "base_color.png", "normal_gl.png", "roughness.png", "height.png"}) {
    EXPECT_TRUE(std::filesystem::exists(target / name)) << name;
  }
  const std::string sidecar = read_file(target / "maps.json");
  EXPECT_NE(sidecar.find("oak.png"), std::string::npos) << sidecar;
  EXPECT_NE(sidecar.find("chain 1, step 1"), std::string::npos) << sidecar;
}

TEST_F(AppPanels, AnExportCanBeEndedOnItsWayAndSaysHowFarItIs) {
  start_run_of({draw(0.4, 0.5, -1)});
  ExportWorker worker;
  ExportRequest request;
  request.material = "bump";
  request.values = prior_location(table_);
  request.resolution = 128;
  const auto end = [&] {
    std::optional<ExportWorker::Outcome> outcome;
    while (!outcome) outcome = worker.take();
    return *outcome;
  };
  worker.start({{request, "a"}, {request, "b"}}, folder_.path() / "whole");
  EXPECT_FALSE(end().cancelled);
  EXPECT_EQ(worker.done(), 1);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "whole" / "b" / "maps.json"));
  std::vector<ExportJob> endless(1000, {request, "again"});
  worker.start(endless, folder_.path() / "part");
  while (worker.done() == 0) continue;
  worker.cancel();
  const ExportWorker::Outcome outcome = end();
  EXPECT_TRUE(outcome.cancelled);
  EXPECT_EQ(outcome.error, "");
  EXPECT_GT(worker.done(), 0);
  EXPECT_LT(worker.done(), 1);
}

TEST_F(AppPanels, AnExportThatFailsSaysSo) {
  start_run_of({draw(0.4, 0.5, -1)});
  press('E', ImGuiKeyModFlags_Ctrl);
  press('A', ImGuiKeyModFlags_Ctrl);
  type((photo_ / "below a file").string());
  ASSERT_TRUE(frames_until([&] { return !app_.exporting(); }));
  EXPECT_TRUE(app_.banner().visible());
}

TEST_F(AppPanels, EveryWindowSizeFromSmallToLargeDraws) {
  start_run_of({draw(0.4, 0.5, -1), draw(0.5, 0.6, -2)});
  window_->type("?");
  answer_input();
  for (const auto& [width, height] : {std::pair{640, 480}, {1280, 800}, {3840, 2160}}) {
    window_->resize(width, height);
    frames(3);
    EXPECT_EQ(window_->screenshot().width, width);
  }
}

}  // namespace
}  // namespace patina::testing
