#include "engine/run/run_photo.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/error.h"
#include "engine/io/image_file.h"
#include "engine/run/manifest.h"
#include "engine/run/run_files.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class RunPhotoTest : public RunTest {
 protected:
  /// Of values that no file of integers has.
  static Photo fine_photo() {
    Photo fine = photo();
    std::mt19937 random(1);
    std::uniform_real_distribution<float> little(-1e-3f, 1e-3f);
    for (float& value : fine.image.pixels) value += little(random);
    return fine;
  }
};

TEST_F(RunPhotoTest, IsReadAsItWasWrittenInEveryStep) {
  Image steps(256, 256, 3);
  for (std::size_t i = 0; i < steps.pixels.size(); ++i)
    steps.pixels[i] = (static_cast<float>(i / 3) + 0.3f) / 65535;
  std::filesystem::create_directory(directory());
  write_image(photo_file(directory()), steps, PixelDepth::u16);
  EXPECT_EQ(read_run_photo(directory()).pixels, as_kept(steps).pixels);
  EXPECT_NE(as_kept(steps).pixels, steps.pixels);
}

TEST_F(RunPhotoTest, IsThatOfTheRunWithItsSquare) {
  Photo cropped = fine_photo();
  cropped.crop = {3, 4, 48};
  cropped.original_width = 60;
  cropped.original_height = 70;
  cropped.warnings = {"One pixel is odd."};
  RunSettings little = settings();
  little.map_only = true;
  draws_to_the_end(*start_run(little, cropped, directory()));
  const Photo kept = photo_of_run(directory());
  EXPECT_EQ(kept.crop, cropped.crop);
  EXPECT_EQ(kept.original_width, 60);
  EXPECT_EQ(kept.original_height, 70);
  EXPECT_EQ(kept.sha256, cropped.sha256);
  EXPECT_EQ(kept.warnings, cropped.warnings);
  EXPECT_EQ(kept.image.pixels, as_kept(cropped.image).pixels);
}

TEST_F(RunPhotoTest, LetsARunGoOnToTheSameDrawsWithoutTheFileThatWasGiven) {
  RunSettings asked = settings();
  draws_to_the_end(*start_run(asked, fine_photo(), folder_ / "undisturbed"));
  asked.draws = 5;
  draws_to_the_end(*start_run(asked, fine_photo(), directory()));
  asked.draws = settings().draws;
  draws_to_the_end(*resume_run(asked, directory()));
  for (int chain = 0; chain < asked.chains; ++chain)
    EXPECT_EQ(rows_of(chain_file(directory(), chain)), rows_of(chain_file(folder_ / "undisturbed", chain)));
}

TEST_F(RunPhotoTest, ThatWasChangedMakesNoMoreDraws) {
  RunSettings asked = settings();
  asked.draws = 5;
  draws_to_the_end(*start_run(asked, fine_photo(), directory()));
  Image darker = read_run_photo(directory());
  for (float& value : darker.pixels) value *= 0.8f;
  write_image(photo_file(directory()), darker, PixelDepth::u16);
  asked.draws = 10;
  const auto run = resume_run(asked, directory());
  draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::failed);
  EXPECT_NE(run->status().message.find("photo.png"), std::string::npos) << run->status().message;
}

TEST_F(RunPhotoTest, OfAFolderWithoutARunIsRefused) {
  EXPECT_THROW(resume_run(settings(), directory()), UserError);
  EXPECT_FALSE(std::filesystem::exists(directory())) << "nothing is begun there";
}

}  // namespace
}  // namespace patina
