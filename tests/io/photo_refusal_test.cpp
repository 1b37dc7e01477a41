#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <random>

#include "engine/io/image_format.h"
#include "engine/io/photo.h"
#include "tests/io/images.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

class PhotoRefusal : public FolderTest {
 protected:
  std::string refusal(const std::filesystem::path& path) const {
    return user_error([&] { load_photo(path); });
  }
};

TEST_F(PhotoRefusal, WhatIsNotAnImage) {
  EXPECT_NE(refusal(file("a.jpg", "not an image")), "");
  EXPECT_NE(refusal(file("empty.png", "")).find("empty"), std::string::npos);
  std::filesystem::create_directory(folder_ / "dir.jpg");
  EXPECT_NE(refusal(folder_ / "dir.jpg").find("not a file"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "missing.jpg").find("No such file"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "a.jpg" / "b.jpg"), "");
}

TEST_F(PhotoRefusal, AFifoIsRefusedInsteadOfWaitedFor) {
  ASSERT_EQ(::mkfifo((folder_ / "fifo.jpg").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder_ / "fifo.jpg"), "");
}

TEST_F(PhotoRefusal, AFileThatMayNotBeReadSaysSo) {
  const auto path = file("secret.png", "x");
  ASSERT_EQ(::chmod(path.c_str(), 0), 0);
  ASSERT_EQ(::chmod(folder_.c_str(), 0755), 0);
  constexpr int kNobody = 65534;
  const auto says_permission = [&] {
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return 2;  // root may read everything
    return refusal(path).find("permission") == std::string::npos ? 1 : 0;
  };
  EXPECT_EQ(exit_status_of(says_permission), 0);
}

TEST_F(PhotoRefusal, ReadersOfOtherThingsAreNeverAsked) {
  // OpenImageIO makes an image of any file with this extension, and plays films.
  EXPECT_NE(refusal(file("a.null", "anything")).find("not an image"), std::string::npos);
  EXPECT_NE(refusal(file("a.mp4", std::string("\0\0\0\x18"
                                              "ftypmp42",
                                              12)))
                .find("not an image"),
            std::string::npos);
}

TEST_F(PhotoRefusal, HeicWithTheWayOut) {
  const std::string bytes(
      "\0\0\0\x18"
      "ftypheic\0\0\0\0mif1heic",
      24);
  EXPECT_NE(refusal(file("IMG_0001.HEIC", bytes)).find("save it as JPEG"), std::string::npos);
}

TEST_F(PhotoRefusal, ATiffThatItsReaderWouldOverrun) {
  write_test_image(folder_ / "a.tif", ramps(40, 40, 1), {OIIO::TypeDesc::UINT16});
  std::string bytes = slurp(folder_ / "a.tif");
  const std::string black_is_zero("\x06\x01\x03\0\x01\0\0\0\x01", 9);  // the tag PhotometricInterpretation
  const auto tag = bytes.find(black_is_zero);
  ASSERT_NE(tag, std::string::npos);
  bytes[tag + 8] = '\0';
  EXPECT_NE(refusal(file("white.tif", bytes)).find("white stored as zero"), std::string::npos);
}

TEST_F(PhotoRefusal, ACamerasRawFileInsteadOfItsSmallPreview) {
  write_test_image(folder_ / "preview.tif", ramps(256, 170, 3));
  std::filesystem::rename(folder_ / "preview.tif", folder_ / "photo.DNG");
  EXPECT_NE(refusal(folder_ / "photo.DNG").find("raw"), std::string::npos);
}

TEST_F(PhotoRefusal, TooSmallASide) {
  for (const auto& [width, height] : {std::pair{1, 1}, {31, 400}, {400, 31}}) {
    write_test_image(folder_ / "a.png", Image(width, height, 3));
    EXPECT_NE(refusal(folder_ / "a.png").find("at least 32"), std::string::npos) << width;
  }
  EXPECT_NE(refusal(file("zero.png", png_header(0, 64))), "");
  write_test_image(folder_ / "just.png", ramps(32, 32, 3));
  EXPECT_EQ(refusal(folder_ / "just.png"), "");
}

TEST_F(PhotoRefusal, TooLargeASideFromTheHeaderAlone) {
  // These files have no pixels at all: only a look at the header can name the size.
  for (const auto& [width, height] : {std::pair{20000u, 20000u}, {16385u, 40u}, {40u, 1000000u}}) {
    const std::string message = refusal(file("a.png", png_header(width, height)));
    EXPECT_NE(message.find("at most 16384"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(width) + " x " + std::to_string(height)), std::string::npos);
  }
  EXPECT_NE(refusal(file("b.png", png_header(16000, 16000))).find("at most 128 megapixels"),
            std::string::npos);
  EXPECT_NE(refusal(file("c.png", png_header(100, 100))).find("damaged"), std::string::npos);
}

TEST_F(PhotoRefusal, MorePixelsThanSoFewBytesCanHold) {
  EXPECT_NE(refusal(file("bomb.png", png_header(10000, 10000))).find("too few for 10000 x 10000"),
            std::string::npos);
  // As well compressed as PNG can.
  write_test_image(folder_ / "flat.png", Image(3000, 3000, 4), {OIIO::TypeDesc::UINT16});
  EXPECT_EQ(refusal(folder_ / "flat.png"), "");
}

TEST_F(PhotoRefusal, MoreMemoryThanThereIs) {
  write_test_image(folder_ / "large.tif", Image(3000, 3000, 3), {OIIO::TypeDesc::FLOAT});
  const auto says_memory = [&] {
    OIIO::attribute("threads", 1);  // a forked process has no pool
    // Room for the pixels as they are, and not for the work on them.
    rlimit limit{};
    ::getrlimit(RLIMIT_DATA, &limit);
    limit.rlim_cur = 150u << 20;
    ::setrlimit(RLIMIT_DATA, &limit);
    return refusal(folder_ / "large.tif").find("memory") == std::string::npos ? 1 : 0;
  };
  EXPECT_EQ(exit_status_of(says_memory), 0);
}

TEST_F(PhotoRefusal, RandomBytesWithAnyKnownBeginning) {
  std::mt19937 generator(7);
  for (const std::string& beginning :
       {std::string("\xFF\xD8\xFF\xE0"), std::string("\x89PNG\r\n\x1A\n"), std::string("II*\0", 4),
        std::string("MM\0*", 4), std::string("\x76\x2F\x31\x01"), std::string("RIFF1234WEBPVP8L"),
        std::string("\0\0\0\x18"
                    "ftypheic",
                    12),
        std::string("\0\0\0\x0CjP  ", 8), std::string("#?RADIANCE\n"), std::string("BM"), std::string("P6 "),
        std::string()})
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::string bytes = beginning;
      for (int i = 0; i < 3000; ++i) bytes += static_cast<char>(generator());
      EXPECT_NE(refusal(file("noise.exr", bytes)), "") << image_format(bytes);
    }
}

}  // namespace
}  // namespace patina
