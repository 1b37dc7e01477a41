#include "engine/io/image_file.h"
#include "engine/io/image_format.h"
#include "engine/io/photo.h"
#include "tests/io/images.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

using ImageTruncation = FolderTest;

/// Coarse noise, so that an encoder cannot squeeze the image into its header.
Image noise(int side) {
  Image image(side, side, 3);
  std::uint32_t state = 1;
  for (float& value : image.pixels)
    value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 24) / 255;
  return image;
}

TEST_F(ImageTruncation, IsRefusedWhereverTheFileWasCut) {
  // The last bytes of some formats carry nothing that a reader needs; a cut before them must not go unseen.
  for (const auto& [name, spare] : {std::pair{"a.jpg", 0},
                                    {"a.png", 0},
                                    {"a.tif", 0},
                                    {"a.exr", 0},
                                    {"a.webp", 0},
                                    {"a.bmp", 0},
                                    {"a.ppm", 0},
                                    {"a.jp2", 4},
                                    {"a.hdr", 0}}) {
    write_test_image(folder_ / name, noise(48));
    const std::string whole = slurp(folder_ / name);
    ASSERT_NO_THROW(load_photo(folder_ / name)) << name;
    for (std::size_t step = 0; step <= 60; ++step) {
      const std::size_t length = (whole.size() - 1 - static_cast<std::size_t>(spare)) * step / 60;
      const auto path = file(std::string("cut-") + name, whole.substr(0, length));
      EXPECT_NE(user_error([&] { load_photo(path); }), "")
          << name << " cut to " << length << " of " << whole.size();
      EXPECT_NE(user_error([&] { read_image(path); }), "") << name << " cut to " << length;
    }
  }
}

TEST_F(ImageTruncation, OfAProgressiveJpegIsRefusedInAnyScan) {
  write_test_image(folder_ / "p.jpg", noise(48),
                   {.adjust = [](OIIO::ImageSpec& spec) { spec.attribute("jpeg:progressive", 1); }});
  const std::string whole = slurp(folder_ / "p.jpg");
  EXPECT_TRUE(image_is_complete(whole));
  ASSERT_NE(whole.find("\xFF\xC2"), std::string::npos) << "not progressive";
  for (std::size_t length = 3; length < whole.size(); ++length)
    ASSERT_FALSE(image_is_complete(std::string_view(whole).substr(0, length))) << length;
}

TEST_F(ImageTruncation, IsSeenBehindAThumbnailThatHasAnEndOfItsOwn) {
  const std::string thumbnail = flat_jpeg(16, 16, {128});
  const std::string photo = flat_jpeg(64, 64, {200, 100, 50});
  const std::size_t length = thumbnail.size() + 2;
  const std::string application_segment =
      std::string("\xFF\xE1") + static_cast<char>(length >> 8) + static_cast<char>(length) + thumbnail;
  const std::string whole = photo.substr(0, 2) + application_segment + photo.substr(2);
  EXPECT_TRUE(image_is_complete(whole));
  EXPECT_EQ(jpeg_components(whole), 3);
  EXPECT_NO_THROW(load_photo(file("whole.jpg", whole)));
  for (std::size_t cut = 1; cut < photo.size(); ++cut)
    ASSERT_FALSE(image_is_complete(std::string_view(whole).substr(0, whole.size() - cut))) << cut;
}

TEST_F(ImageTruncation, IsNotSeenInWhatAPhoneAppends) {
  // A motion photo: the film's bytes look like markers here and there.
  const std::string film = std::string(
                               "\0\0\0\x18"
                               "ftypmp42",
                               12) +
                           "\xFF\xDA\x01\x02\xFF\xD9\xFF\xDA" + std::string(500, 'x');
  const std::string photo = flat_jpeg(40, 40, {90, 128, 128}) + film;
  EXPECT_TRUE(image_is_complete(photo));
  EXPECT_NO_THROW(load_photo(file("motion.jpg", photo)));
}

TEST_F(ImageTruncation, OfTheRealPhotosIsRefused) {
  const std::filesystem::path photos = std::filesystem::path(PATINA_SHARED_DIR) / "photos";
  if (!std::filesystem::exists(photos / "bump_3.jpg")) GTEST_SKIP() << "no test photos in " << photos;
  const std::string whole = slurp(photos / "bump_3.jpg");
  EXPECT_NO_THROW(load_photo(photos / "bump_3.jpg"));
  for (const std::size_t length : {std::size_t{900}, whole.size() / 2, whole.size() - 1}) {
    const auto path = file("cut.jpg", whole.substr(0, length));
    EXPECT_NE(user_error([&] { load_photo(path); }).find("incomplete"), std::string::npos) << length;
  }
}

}  // namespace
}  // namespace patina
