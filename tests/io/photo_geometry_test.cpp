#include <array>
#include <cmath>
#include <numbers>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/photo.h"
#include "tests/io/folder_test.h"
#include "tests/io/images.h"

namespace patina {
namespace {

using PhotoGeometry = FolderTest;

/// Where EXIF 2.32 (tag 274) says the stored pixel belongs when the photo is seen upright.
Image upright(const Image& stored, int orientation) {
  const int w = stored.width, h = stored.height;
  Image result = orientation <= 4 ? Image(w, h, stored.channels) : Image(h, w, stored.channels);
  for (int row = 0; row < h; ++row)
    for (int column = 0; column < w; ++column) {
      const int across[] = {column, w - 1 - column, w - 1 - column, column,
                            row,    h - 1 - row,    h - 1 - row,    row};
      const int down[] = {row, row, h - 1 - row, h - 1 - row, column, column, w - 1 - column, w - 1 - column};
      for (int c = 0; c < stored.channels; ++c)
        result.at(down[orientation - 1], across[orientation - 1], c) = stored.at(row, column, c);
    }
  return result;
}

TEST_F(PhotoGeometry, AllEightOrientationsAreUndone) {
  const Image stored = ramps(64, 48, 3);
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const char* extension : {".tif", ".jpg"}) {
      SCOPED_TRACE(extension + std::to_string(orientation));
      const auto path = folder_ / ("o" + std::to_string(orientation) + extension);
      write_test_image(path, stored, {.adjust = [&](OIIO::ImageSpec& spec) {
                         spec.attribute("Orientation", orientation);
                         spec.attribute("jpeg:subsampling", "4:4:4");
                       }});
      const Photo photo = load_photo(path);
      const Image whole = upright(stored, orientation);
      EXPECT_EQ(photo.original_width, whole.width);
      EXPECT_EQ(photo.original_height, whole.height);
      const Image expected = crop(whole, (whole.width - 48) / 2, (whole.height - 48) / 2, 48);
      EXPECT_LT(max_difference(photo.image, expected), extension == std::string(".tif") ? kEightBit : 0.03f);
      EXPECT_TRUE(photo.warnings.empty());
    }
}

TEST_F(PhotoGeometry, ACropIsOfTheUprightPhotoWhateverTheOrientation) {
  const Image stored = ramps(64, 48, 3);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    const auto path = folder_ / ("c" + std::to_string(orientation) + ".tif");
    write_test_image(path, stored,
                     {.adjust = [&](OIIO::ImageSpec& spec) { spec.attribute("Orientation", orientation); }});
    const PhotoCrop wanted{9, 3, 35};
    const Photo photo = load_photo(path, {.crop = wanted});
    EXPECT_EQ(photo.crop, wanted);
    EXPECT_LT(max_difference(photo.image, crop(upright(stored, orientation), 9, 3, 35)), kEightBit);
  }
}

TEST_F(PhotoGeometry, ACropOutsideThePhotoOrTooSmallIsRefused) {
  write_test_image(folder_ / "a.png", ramps(64, 48, 3));
  for (const PhotoCrop& bad : {PhotoCrop{-1, 0, 40},
                               {0, -1, 40},
                               {25, 0, 40},
                               {0, 9, 40},
                               {0, 0, 31},
                               {0, 0, 49},
                               {2'000'000'000, 0, 2'000'000'000}}) {
    EXPECT_THROW(load_photo(folder_ / "a.png", {.crop = bad}), UserError) << bad.x << "," << bad.y;
  }
  EXPECT_NO_THROW(load_photo(folder_ / "a.png", {.crop = PhotoCrop{24, 8, 40}}));
}

TEST_F(PhotoGeometry, WithoutACropTheCentralOneIsTakenAndNamed) {
  write_test_image(folder_ / "a.png", ramps(64, 48, 3));
  const Photo central = load_photo(folder_ / "a.png");
  EXPECT_EQ(central.crop, (PhotoCrop{8, 0, 48}));
  EXPECT_EQ(max_difference(central.image, load_photo(folder_ / "a.png", {.crop = central.crop}).image), 0);
}

TEST_F(PhotoGeometry, TheWholePhotoComesReducedAndUprightWhereItIsAskedFor) {
  const Image stored = ramps(120, 60, 3);
  write_test_image(folder_ / "a.tif", stored,
                   {.adjust = [](OIIO::ImageSpec& spec) { spec.attribute("Orientation", 6); }});
  EXPECT_TRUE(load_photo(folder_ / "a.tif").whole.empty());
  EXPECT_LT(max_difference(load_photo(folder_ / "a.tif", {.whole_side = 500}).whole, upright(stored, 6)),
            kEightBit);
  const Image reduced = load_photo(folder_ / "a.tif", {.whole_side = 60}).whole;
  EXPECT_EQ(reduced.width, 30);
  EXPECT_EQ(reduced.height, 60);
}

TEST_F(PhotoGeometry, TheFocalLengthIsReadFromExifInPixelsOfTheWholePhoto) {
  write_test_image(folder_ / "plain.jpg", ramps(64, 48, 3));
  EXPECT_FALSE(load_photo(folder_ / "plain.jpg").focal_pixels);
  write_test_image(folder_ / "phone.jpg", ramps(64, 48, 3), {.adjust = [](OIIO::ImageSpec& spec) {
                     spec.attribute("Exif:FocalLengthIn35mmFilm", OIIO::TypeDesc::UINT16,
                                    std::array<unsigned short, 1>{26}.data());
                   }});
  const Photo photo = load_photo(folder_ / "phone.jpg");
  ASSERT_TRUE(photo.focal_pixels);
  EXPECT_NEAR(*photo.focal_pixels, 26 * 80 / std::hypot(36, 24), 1e-9);
}

TEST_F(PhotoGeometry, AnUnknownOrientationIsTakenAsUpright) {
  write_test_image(folder_ / "a.tif", ramps(40, 40, 3),
                   {.adjust = [](OIIO::ImageSpec& spec) { spec.attribute("Orientation", 77); }});
  EXPECT_LT(max_difference(load_photo(folder_ / "a.tif").image, ramps(40, 40, 3)), kEightBit);
}

TEST_F(PhotoGeometry, TheCentralSquareIsKept) {
  write_test_image(folder_ / "wide.png", ramps(120, 50, 3));
  write_test_image(folder_ / "tall.png", ramps(50, 120, 3));
  EXPECT_LT(max_difference(load_photo(folder_ / "wide.png").image, crop(ramps(120, 50, 3), 35, 0, 50)),
            kEightBit);
  EXPECT_LT(max_difference(load_photo(folder_ / "tall.png").image, crop(ramps(50, 120, 3), 0, 35, 50)),
            kEightBit);
}

TEST_F(PhotoGeometry, AnOpenExrDataWindowAwayFromTheOriginIsReadWhole) {
  write_test_image(folder_ / "window.exr", uniform(80, 60, {1, 0, 0}),
                   {OIIO::TypeDesc::HALF, [](OIIO::ImageSpec& spec) {
                      spec.x = -13;
                      spec.y = 29;
                      spec.full_width = 500;
                      spec.full_height = 400;
                    }});
  EXPECT_LT(max_difference(load_photo(folder_ / "window.exr").image, uniform(60, 60, {1, 0, 0})), 1e-6f);
}

TEST_F(PhotoGeometry, ALargePhotoIsReducedWithoutAShift) {
  // A ramp reduced is the ramp itself at the new pixel centres, whatever the filter, away from the edges.
  constexpr int kSide = 2000;
  Image large(kSide, kSide, 3);
  const auto value = [](double position, int c) {
    return static_cast<float>(0.2 + 0.2 * c * position + 0.1 * std::sin(4 * std::numbers::pi * position));
  };
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      for (int c = 0; c < 3; ++c) large.at(row, column, c) = value((column + 0.5) / kSide, c);
  write_test_image(folder_ / "large.tif", large, {OIIO::TypeDesc::UINT16});
  const Photo photo = load_photo(folder_ / "large.tif");
  ASSERT_EQ(photo.image.width, kWorkingPhotoSide);
  ASSERT_EQ(photo.image.height, kWorkingPhotoSide);
  EXPECT_EQ(photo.original_width, kSide);
  float worst = 0;
  for (int row = 8; row < kWorkingPhotoSide - 8; row += 61)
    for (int column = 8; column < kWorkingPhotoSide - 8; ++column)
      for (int c = 0; c < 3; ++c)
        worst = std::max(
            worst, std::abs(photo.image.at(row, column, c) - value((column + 0.5) / kWorkingPhotoSide, c)));
  EXPECT_LT(worst, 1e-4f);
}

TEST_F(PhotoGeometry, ReducingNeverLeavesTheRange) {
  Image checker(96, 96, 3);
  for (int row = 0; row < 96; ++row)
    for (int column = 0; column < 96; ++column)
      for (int c = 0; c < 3; ++c) checker.at(row, column, c) = (row / 7 + column / 7) % 2;
  for (const int side : {32, 64, 200}) {
    const Image result = resized(checker, side);
    ASSERT_EQ(result.width, side);
    EXPECT_GE(*std::ranges::min_element(result.pixels), 0.0f);
    EXPECT_LE(*std::ranges::max_element(result.pixels), 1.0f);
  }
  EXPECT_LT(
      max_difference(resized(uniform(100, 100, {0.2f, 0.5f, 0.7f}), 64), uniform(64, 64, {0.2f, 0.5f, 0.7f})),
      1e-5f);
  EXPECT_EQ(max_difference(resized(checker, 96), checker), 0.0f);
}

TEST_F(PhotoGeometry, TheDigestIsOfTheFile) {
  write_test_image(folder_ / "a.png", ramps(40, 40, 3));
  EXPECT_EQ(load_photo(folder_ / "a.png").sha256, sha256_hex(slurp(folder_ / "a.png")));
}

}  // namespace
}  // namespace patina
