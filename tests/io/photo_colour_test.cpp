#include <cmath>
#include <limits>

#include "engine/io/image_format.h"
#include "engine/io/photo.h"
#include "tests/io/folder_test.h"
#include "tests/io/images.h"

namespace patina {
namespace {

constexpr float kSixteenBit = 0.51f / 65535;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class PhotoColour : public FolderTest {
 protected:
  Photo load(const std::string& name, const Image& image, const FileKind& kind = {}) {
    write_test_image(folder_ / name, image, kind);
    return load_photo(folder_ / name);
  }
};

/// The words that one of the warnings must have.
bool warns(const Photo& photo, const std::string& words) {
  for (const std::string& warning : photo.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

Image first_channels(const Image& image, const std::vector<int>& channels) {
  Image result(image.width, image.height, static_cast<int>(channels.size()));
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      for (int c = 0; c < result.channels; ++c)
        result.at(row, column, c) = image.at(row, column, channels[static_cast<std::size_t>(c)]);
  return result;
}

TEST_F(PhotoColour, GreyBecomesThreeEqualChannels) {
  const Image grey = ramps(40, 40, 1);
  for (const char* name : {"a.png", "a.tif"}) {
    const Photo photo = load(name, grey);
    EXPECT_LT(max_difference(photo.image, first_channels(grey, {0, 0, 0})), kEightBit) << name;
    EXPECT_TRUE(photo.warnings.empty()) << name;
  }
  EXPECT_LT(max_difference(load("a.jpg", grey).image, first_channels(grey, {0, 0, 0})), 0.02f);
}

TEST_F(PhotoColour, SixteenBitsAreKept) {
  for (const char* name : {"a.png", "a.tif"})
    EXPECT_LT(max_difference(load(name, ramps(40, 40, 3), {OIIO::TypeDesc::UINT16}).image, ramps(40, 40, 3)),
              kSixteenBit)
        << name;
}

TEST_F(PhotoColour, AlphaIsLeftOutAndOnlyTransparencyIsWarnedAbout) {
  Image image = ramps(40, 40, 4);
  for (const float alpha : {1.0f, 0.25f}) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = alpha;
    for (const char* name : {"a.png", "a.tif"}) {
      const Photo photo = load(name, image, {OIIO::TypeDesc::UINT16});
      EXPECT_LT(max_difference(photo.image, first_channels(image, {0, 1, 2})), 2 * kSixteenBit) << name;
      EXPECT_EQ(warns(photo, "transparen"), alpha < 1) << name;
    }
  }
}

TEST_F(PhotoColour, GreyWithAlphaBecomesThreeEqualChannels) {
  const Image image = uniform(40, 40, {0.6f, 0.5f});
  const Photo photo = load("a.png", image);
  EXPECT_LT(max_difference(photo.image, uniform(40, 40, {0.6f, 0.6f, 0.6f})), 2 * kEightBit);
  EXPECT_TRUE(warns(photo, "transparen"));
}

TEST_F(PhotoColour, SpareChannelsAreLeftOutWithAWarning) {
  for (const int channels : {2, 5, 9}) {
    const Image image = ramps(40, 40, channels);
    const Photo photo =
        load("a.tif", image, {.adjust = [](OIIO::ImageSpec& spec) { spec.alpha_channel = -1; }});
    const Image expected = first_channels(image, channels == 2 ? std::vector{0, 0, 0} : std::vector{0, 1, 2});
    EXPECT_LT(max_difference(photo.image, expected), 2 * kEightBit) << channels;
    EXPECT_FALSE(photo.warnings.empty()) << channels;
  }
}

TEST_F(PhotoColour, LinearLightIsEncodedAsSrgbAndClippedAtWhite) {
  // Encoded values from the definition in IEC 61966-2-1: 0.5 -> 0.735357, 0.002 -> 0.02584.
  const Photo photo = load("a.exr", uniform(40, 40, {0.5f, 0.002f, 7.0f}), {OIIO::TypeDesc::FLOAT});
  EXPECT_LT(max_difference(photo.image, uniform(40, 40, {0.735357f, 0.02584f, 1.0f})), 1e-6f);
  EXPECT_TRUE(photo.warnings.empty());
  EXPECT_LT(max_difference(load("b.exr", uniform(40, 40, {-3.0f, 0, 0})).image, uniform(40, 40, {0, 0, 0})),
            1e-6f);
}

TEST_F(PhotoColour, HalfFloatTiffAndRadianceAreLinearToo) {
  for (const char* name : {"a.tif", "a.hdr", "half.exr"}) {
    const FileKind kind{name == std::string("half.exr") ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT};
    EXPECT_LT(max_difference(load(name, uniform(40, 40, {0.5f, 0.25f, 1}), kind).image,
                             uniform(40, 40, {0.735357f, 0.537099f, 1})),
              0.002f)
        << name;
  }
}

TEST_F(PhotoColour, WhatIsNotANumberIsMendedAndCounted) {
  Image image = uniform(40, 40, {0, 0, 0});
  image.at(0, 0, 0) = kNan;
  image.at(0, 0, 1) = kNan;  // the same pixel counts once
  image.at(7, 9, 2) = kInfinity;
  image.at(39, 39, 1) = -kInfinity;
  for (const char* name : {"a.exr", "a.tif"}) {
    const Photo photo = load(name, image, {OIIO::TypeDesc::FLOAT});
    Image expected = uniform(40, 40, {0, 0, 0});
    expected.at(7, 9, 2) = 1;
    EXPECT_LT(max_difference(photo.image, expected), 1e-6f) << name;
    EXPECT_TRUE(warns(photo, " 3 pixels")) << name;
  }
}

TEST_F(PhotoColour, NeitherNanNorHugeValuesSpreadWhenAPhotoIsReduced) {
  Image image = uniform(1200, 1200, {0.5f, 0.5f, 0.5f});
  for (int i = 0; i < 1200; i += 100) {
    image.at(i, i, 0) = kNan;
    image.at(i, i, 1) = kInfinity;
    image.at(i, 600, 2) = std::numeric_limits<float>::max();
    image.at(i, 601, 2) = -std::numeric_limits<float>::max();
  }
  const Photo photo = load("a.exr", image, {OIIO::TypeDesc::FLOAT});
  int changed = 0;
  for (const float value : photo.image.pixels) {
    ASSERT_TRUE(value >= 0 && value <= 1);
    changed += std::abs(value - 0.735357f) > 0.01f;
  }
  EXPECT_LT(changed, 12 * 4 * 49 * 2);
  EXPECT_GT(changed, 0);
}

TEST_F(PhotoColour, CmykJpegIsConvertedWithAWarning) {
  // Adobe stores the inverse of the ink: no cyan, full magenta, half yellow, no black.
  const auto path = file("cmyk.jpg", flat_jpeg(40, 40, {255, 0, 128, 255}));
  const Photo photo = load_photo(path);
  EXPECT_LT(max_difference(photo.image, uniform(40, 40, {1, 0, 0.5f})), 0.02f);
  EXPECT_TRUE(warns(photo, "CMYK"));
}

TEST_F(PhotoColour, CmykTiffIsConvertedWithAWarning) {
  const Photo photo =
      load("cmyk.tif", uniform(40, 40, {0.9f, 0.2f, 0.4f}),
           {.adjust = [](OIIO::ImageSpec& spec) { spec.attribute("tiff:ColorSpace", "CMYK"); }});
  EXPECT_LT(max_difference(photo.image, uniform(40, 40, {0.9f, 0.2f, 0.4f})), 0.02f);
  EXPECT_TRUE(warns(photo, "CMYK"));
}

TEST_F(PhotoColour, OrdinaryJpegsHaveNoWarning) {
  for (const std::vector<int>& components : {std::vector{128}, std::vector{128, 128, 128}}) {
    const Photo photo = load_photo(file("flat.jpg", flat_jpeg(40, 40, components)));
    EXPECT_LT(max_difference(photo.image, uniform(40, 40, {0.502f, 0.502f, 0.502f})), 0.01f);
    EXPECT_TRUE(photo.warnings.empty());
  }
}

TEST_F(PhotoColour, FurtherKindsOfImagesAreRead) {
  for (const char* name : {"a.webp", "a.bmp", "a.ppm", "a.jp2"})
    EXPECT_LT(max_difference(load(name, ramps(64, 64, 3)).image, ramps(64, 64, 3)), 0.05f) << name;
}

TEST_F(PhotoColour, ContentsDecideNotTheExtension) {
  write_test_image(folder_ / "a.png", ramps(40, 40, 3));
  std::filesystem::rename(folder_ / "a.png", folder_ / "a.exr");
  EXPECT_LT(max_difference(load_photo(folder_ / "a.exr").image, ramps(40, 40, 3)), kEightBit);
}

}  // namespace
}  // namespace patina
