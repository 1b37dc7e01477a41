#include <fstream>

#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

/// A wide photo: dark on the left, bright on the right.
class AppPhoto : public AppTest {
 protected:
  AppPhoto() {
    Image image(160, 80, 3);
    for (int row = 0; row < 80; ++row)
      for (int column = 0; column < 160; ++column)
        for (int c = 0; c < 3; ++c) image.at(row, column, c) = column < 80 ? 0.2f : 0.8f;
    write_image(wide_, image);
  }

  void drop(std::vector<std::filesystem::path> files) {
    window_->drop_files(std::move(files));
    answer_input();
    ASSERT_TRUE(frames_until([&] { return !app_.loading(); }));
    frames(2);
  }

  /// A point of the photo, in its pixels, in the window.
  ImVec2 spot(float x, float y) {
    const Rect& place = app_.photo_panel().place();
    return {place.position.x + x / 160 * place.size.x, place.position.y + y / 80 * place.size.y};
  }
  void drag(ImVec2 from, ImVec2 to) {
    window_->drag(from.x, from.y, to.x, to.y);
    answer_input();
    ASSERT_TRUE(frames_until([&] { return app_.session().photo_is_current() && !app_.loading(); }));
    frames(2);
  }
  float mean_of_square() const {
    const Image& image = app_.session().photo().image;
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return static_cast<float>(sum / static_cast<double>(image.pixels.size()));
  }

  std::filesystem::path wide_ = folder_.path() / "wide plank.png";
};

TEST_F(AppPhoto, TheSquareIsDraggedToAnotherPartOfThePhoto) {
  drop({wide_});
  ASSERT_EQ(app_.session().photo().crop, (PhotoCrop{40, 0, 80}));
  EXPECT_NEAR(mean_of_square(), 0.5, 0.01);
  drag(spot(80, 40), spot(130, 40));
  EXPECT_EQ(app_.session().photo().crop, (PhotoCrop{80, 0, 80}));
  EXPECT_NEAR(mean_of_square(), 0.8, 0.01);
  press('Z', ImGuiKeyModFlags_Ctrl);
  ASSERT_TRUE(frames_until([&] { return app_.session().photo_is_current(); }));
  EXPECT_NEAR(mean_of_square(), 0.5, 0.01);
}

TEST_F(AppPhoto, ASmallerSquareIsNarrowerInCentimetresUnderTheSameCamera) {
  drop({wide_});
  const Capture before = app_.session().settings().capture;
  drag(spot(40, 0), spot(80, 40));
  EXPECT_NEAR(app_.session().photo().crop.side, 40, 1);
  const Capture after = app_.session().settings().capture;
  EXPECT_NEAR(after.size_cm, before.size_cm * app_.session().photo().crop.side / 80, 1e-9);
  EXPECT_EQ(after.camera_cm, before.camera_cm);
}

TEST_F(AppPhoto, AnotherSquareWaitsForTheNextRunAndLeavesThisOneAlone) {
  drop({wide_});
  app_.session().start();
  run_->status.phase = RunPhase::sampling;
  frames(2);
  drag(spot(80, 40), spot(130, 40));
  EXPECT_TRUE(app_.session().has_run());
  EXPECT_TRUE(app_.session().choices_wait());
  EXPECT_NEAR(app_.session().run().photo().at(0, 0, 0), 0.2, 0.01) << "the run keeps its own square";
  app_.session().start();
  EXPECT_NEAR(app_.session().run().photo().at(0, 0, 0), 0.8, 0.01);
  EXPECT_FALSE(app_.session().choices_wait());
}

TEST_F(AppPhoto, SeveralFilesAreAskedAboutAndOneIsOpened) {
  drop({photo_, wide_});
  ASSERT_TRUE(app_.file_choice().visible());
  EXPECT_FALSE(app_.session().has_photo());
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_FALSE(app_.file_choice().visible());
  drop({photo_, wide_});
  const ImVec2 centre{640, 400};
  click({centre.x, centre.y + 0.8f * ImGui::GetFontSize()});
  ASSERT_TRUE(frames_until([&] { return app_.session().has_photo(); }));
  EXPECT_EQ(app_.session().photo_name(), "wide plank");
}

TEST_F(AppPhoto, ACopiedPathIsOpened) {
  for (const std::string& text :
       {"'" + wide_.string() + "'\n", "file://" + folder_.path().string() + "/wide%20plank.png"}) {
    app_.load(photo_);
    ImGui::SetClipboardText(text.c_str());
    press('V', ImGuiKeyModFlags_Ctrl);
    ASSERT_TRUE(frames_until([&] { return app_.session().photo_name() == "wide plank"; })) << text;
  }
  ImGui::SetClipboardText("what I had for lunch");
  press('V', ImGuiKeyModFlags_Ctrl);
  ASSERT_TRUE(frames_until([&] { return app_.banner().visible(); }));
  EXPECT_EQ(app_.session().photo_name(), "wide plank");
}

TEST_F(AppPhoto, TheNewestOfPhotosOpenedInARowWins) {
  app_.open(photo_);
  app_.open(folder_.path() / "nothing.png");
  app_.open(wide_);
  ASSERT_TRUE(frames_until([&] { return !app_.loading(); }));
  frames(2);
  EXPECT_EQ(app_.session().photo_name(), "wide plank");
  EXPECT_FALSE(app_.banner().visible()) << app_.banner().sentence();
}

TEST_F(AppPhoto, APhotoThatIsOpenedWhileASquareOfAnotherIsReadWins) {
  drop({wide_});
  app_.session().crop_to({0, 0, 60});
  app_.frame(0);
  ASSERT_TRUE(app_.loading());
  app_.open(photo_);
  ASSERT_TRUE(frames_until([&] { return !app_.loading(); }));
  frames(3);
  EXPECT_EQ(app_.session().photo_name(), "oak");
  EXPECT_TRUE(app_.session().photo_is_current());
}

TEST_F(AppPhoto, ClippedPartsAreMarked) {
  Image image(80, 80, 3);
  for (int i = 0; i < 80 * 40 * 3; ++i) image.pixels[static_cast<std::size_t>(i)] = 1;
  write_image(photo_, image);
  drop({photo_});
  const Rect& place = app_.photo_panel().place();
  const auto green = [&](float down) {
    return window_->screenshot().at(static_cast<int>(place.position.y + down * place.size.y),
                                    static_cast<int>(place.position.x + 0.5f * place.size.x), 1);
  };
  EXPECT_NEAR(green(0.25f), 1, 0.01);
  press('C');
  EXPECT_LT(green(0.25f), 0.3);
  EXPECT_NEAR(green(0.75f), 0, 0.01) << "what is not clipped is seen as it is";
}

TEST_F(AppPhoto, APhotoThatIsGoneWhenItIsCroppedAgainSaysSoAndKeepsItsSquare) {
  drop({wide_});
  std::filesystem::remove(wide_);
  window_->drag(spot(80, 40).x, spot(80, 40).y, spot(130, 40).x, spot(130, 40).y);
  answer_input();
  ASSERT_TRUE(frames_until([&] { return app_.banner().visible(); }));
  frames(3);
  EXPECT_TRUE(app_.session().photo_is_current());
  EXPECT_EQ(app_.session().photo().crop, (PhotoCrop{40, 0, 80}));
}

TEST_F(AppPhoto, ShowsTheSquareAsCoarseAsTheRunSeesIt) {
  // Stripes that the window can show, of a period below two of the run's 192 pixels a side.
  Image fine(1024, 1024, 3);
  for (int row = 0; row < 1024; ++row)
    for (int column = 0; column < 1024; ++column)
      for (int c = 0; c < 3; ++c) fine.at(row, column, c) = column % 8 < 4 ? 1.0f : 0.0f;
  write_image(folder_.path() / "fine.png", fine);
  app_.load(folder_.path() / "fine.png");
  const auto spread = [&] {
    frames(2);
    const Image shown = part_of(window_->screenshot(), app_.photo_panel().place());
    float low = 1, high = 0;
    for (int row = shown.height / 4; row < 3 * shown.height / 4; ++row)
      for (int column = shown.width / 4; column < 3 * shown.width / 4; ++column) {
        low = std::min(low, shown.at(row, column, 0));
        high = std::max(high, shown.at(row, column, 0));
      }
    return high - low;
  };
  app_.photo_panel().show_seen(true);
  EXPECT_LT(spread(), 0.1f) << "an even grey";
  app_.photo_panel().show_seen(false);
  EXPECT_GT(spread(), 0.1f);
}

TEST_F(AppPhoto, APhotoOfTheCommandLineIsReadBehindTheFirstFramesThenItsRunStarts) {
  app_.open_and_start(photo_);
  EXPECT_TRUE(app_.loading());
  EXPECT_FALSE(app_.session().has_photo());
  ASSERT_TRUE(frames_until([&] { return app_.session().has_run(); }));
  EXPECT_EQ(app_.session().photo_name(), "oak");
  app_.open(photo_);
  ASSERT_TRUE(frames_until([&] { return !app_.loading(); }));
  frames(2);
  EXPECT_FALSE(app_.session().has_run()) << "a photo that is opened by hand waits for Start";
}

TEST_F(AppPhoto, ARunThatStartsByItselfWaitsForTheMaterialThatIsSeenAtAGlance) {
  table_ = material_table("leather");
  RankedMaterial leather;
  leather.material = "leather";
  leather.match = prior_location(table_);
  ranking_ = MaterialRanking{{leather}, "gram", "leather."};
  app_.open_and_start(photo_);
  ASSERT_TRUE(frames_until([&] { return app_.session().has_run(); }));
  EXPECT_EQ(app_.session().run().settings().material, "leather");
}

TEST_F(AppPhoto, APhotoThatCannotBeReadStartsNothing) {
  app_.open_and_start(folder_.path() / "nothing.jpg");
  ASSERT_TRUE(frames_until([&] { return app_.banner().visible(); }));
  frames(2);
  EXPECT_FALSE(app_.session().has_run());
}

}  // namespace
}  // namespace patina::testing
