#include "engine/io/image_file.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "tests/io/file_size_limit.h"
#include "tests/io/images.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

class ImageFile : public FolderTest {
 protected:
  int entries() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
};

/// The image with its values rounded to so many steps of [0, 1].
Image quantised(Image image, float steps) {
  for (float& value : image.pixels) value = std::round(value * steps) / steps;
  return image;
}

TEST_F(ImageFile, IntegersReadBackExactly) {
  for (const int channels : {1, 3, 4})
    for (const char* name : {"a.png", "b.tif"}) {
      const Image image = ramps(37, 23, channels);
      write_image(folder_ / name, image, PixelDepth::u8);
      EXPECT_LT(max_difference(read_image(folder_ / name), quantised(image, 255)), 1e-6f) << name << channels;
      write_image(folder_ / name, image, PixelDepth::u16);
      EXPECT_LT(max_difference(read_image(folder_ / name), quantised(image, 65535)), 1e-6f)
          << name << channels;
    }
}

TEST_F(ImageFile, FloatsReadBackExactlyBeyondTheDisplayRangeToo) {
  Image image = ramps(37, 23, 3);
  image.at(0, 0, 0) = -12.5f;
  image.at(1, 2, 1) = 1e30f;
  image.at(2, 3, 2) = std::numeric_limits<float>::infinity();
  for (const char* name : {"a.exr", "a.tiff"}) {
    write_image(folder_ / name, image, PixelDepth::f32);
    EXPECT_EQ(read_image(folder_ / name).pixels, image.pixels) << name;
  }
}

TEST_F(ImageFile, HalfFloatsKeepElevenBits) {
  const Image image = ramps(37, 23, 3);
  write_image(folder_ / "a.exr", image, PixelDepth::f16);
  const float error = max_difference(read_image(folder_ / "a.exr"), image);
  EXPECT_LE(error, std::ldexp(1.0f, -12));
  EXPECT_GT(error, std::ldexp(1.0f, -15)) << "that was not half precision";
}

TEST_F(ImageFile, JpegIsWrittenWithLittleLoss) {
  write_image(folder_ / "a.JPG", ramps(40, 40, 3));
  EXPECT_LT(max_difference(read_image(folder_ / "a.JPG"), ramps(40, 40, 3)), 0.03f);
}

TEST_F(ImageFile, AnUnknownExtensionIsRefusedAndNothingIsLeft) {
  for (const char* name : {"a.xyz", "a", "a.null", "a.mp4"})
    EXPECT_NE(user_error([&] { write_image(folder_ / name, ramps(8, 8, 3)); }).find(".png"),
              std::string::npos);
  EXPECT_EQ(entries(), 0);
}

TEST_F(ImageFile, AFullDiskIsNamedAndTheOldImageStays) {
  for (const char* name : {"a.png", "a.tif", "a.exr", "a.jpg"}) {
    const auto path = folder_ / name;
    write_image(path, uniform(8, 8, {1, 0, 0}));
    const std::string before = slurp(path);
    {
      const FileSizeLimit limit(2000);
      const std::string message = user_error([&] { write_image(path, ramps(500, 500, 3), PixelDepth::u16); });
      EXPECT_NE(message.find("disk is full"), std::string::npos) << name << message;
    }
    EXPECT_TRUE(slurp(path) == before) << name;
  }
  EXPECT_EQ(entries(), 4) << "a temporary file is left";
  EXPECT_NE(user_error([&] { write_image(folder_ / "no" / "a.png", ramps(8, 8, 3)); }), "");
}

TEST_F(ImageFile, AReaderSeesTheOldImageOrTheWholeNewOne) {
  const auto path = folder_ / "a.png";
  const Image black = uniform(200, 200, {0, 0, 0}), white = uniform(200, 200, {1, 1, 1});
  write_image(path, black);
  std::atomic<bool> stop = false;
  std::thread writer([&] {
    for (int i = 0; i < 60; ++i) write_image(path, i % 2 ? black : white);
    stop = true;
  });
  int seen = 0;
  while (!stop) {
    const Image image = read_image(path);
    ASSERT_EQ(image.pixels, uniform(200, 200, {image.pixels[0], image.pixels[0], image.pixels[0]}).pixels);
    ++seen;
  }
  writer.join();
  EXPECT_GT(seen, 0);
}

TEST_F(ImageFile, SmallImagesThatAreNoPhotosAreReadToo) {
  write_image(folder_ / "dot.png", uniform(1, 1, {0.2f, 0.4f, 0.6f}));
  EXPECT_LT(max_difference(read_image(folder_ / "dot.png"), uniform(1, 1, {0.2f, 0.4f, 0.6f})), 1e-6f);
}

}  // namespace
}  // namespace patina
