// Random changes of good files, under the address and undefined-behaviour sanitizers: every parser must take
// them or throw UserError, and do nothing else. --gtest_random_seed=N tries other changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "engine/io/chain_csv.h"
#include "engine/io/image_file.h"
#include "engine/io/image_format.h"
#include "engine/io/params_json.h"
#include "engine/io/photo.h"
#include "tests/io/images.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

/// A source of changed copies of a file's bytes.
class Mutator {
 public:
  explicit Mutator(unsigned salt)
      : generator_(static_cast<unsigned>(GTEST_FLAG_GET(random_seed)) * 977 + salt) {}

  std::string changed(std::string bytes) {
    for (std::size_t changes = 1 + below(2) * below(4); changes > 0 && !bytes.empty(); --changes)
      change(bytes);
    return bytes;
  }
  std::size_t below(std::size_t limit) { return generator_() % limit; }

 private:
  void change(std::string& bytes) {
    // Headers are short and decide most: half of all changes fall into the first bytes.
    const std::size_t at = below(below(2) ? bytes.size() : std::min<std::size_t>(bytes.size(), 128));
    const std::size_t length = std::min(below(40), bytes.size() - at);
    switch (below(9)) {  // mostly in place: a shift of everything behind is what parsers refuse at once
      case 0:
      case 4:
      case 5:
        bytes[at] = static_cast<char>(generator_());
        break;
      case 1:
      case 6:
        bytes[at] = "\xFF\x7F\x80\x01\n,#-\"{"[below(10)];
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 7:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      default:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(length, 4),
                    below(2) ? '\xFF' : '\0');
    }
  }
  std::mt19937 generator_;
};

class ParserFuzz : public FolderTest {
 protected:
  /// Feeds changed copies of good bytes to a parser, which must take some and refuse some: a fuzz that stops
  /// at the front door tries nothing.
  template <typename Parse>
  void fuzz(const std::string& good, int rounds, unsigned salt, Parse&& parse) {
    ASSERT_NO_THROW(parse(file("good", good)));
    Mutator mutator(salt);
    int taken = 0;
    for (int round = 0; round < rounds; ++round) {
      const auto path = file("changed", with_png_checksums(mutator.changed(good)));
      try {
        parse(path);
        ++taken;
      } catch (const UserError& error) {
        ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      }
    }
    EXPECT_GT(taken, rounds / 100) << "the changes are too wild";
    EXPECT_LT(taken, rounds - rounds / 100) << "the changes are too tame";
    std::cout << taken << " of " << rounds << " changed files were taken\n";
  }
};

TEST_F(ParserFuzz, Photos) {
  const auto load = [](const std::filesystem::path& path) {
    const Photo photo = load_photo(path);
    ASSERT_EQ(photo.image.channels, 3);
    ASSERT_EQ(photo.image.width, photo.image.height);
    ASSERT_TRUE(
        std::ranges::all_of(photo.image.pixels, [](float value) { return value >= 0 && value <= 1; }));
  };
  unsigned salt = 0;
  for (const char* name :
       {"a.jpg", "a.png", "a.tif", "a.exr", "a.webp", "a.bmp", "a.ppm", "a.jp2", "a.hdr"}) {
    SCOPED_TRACE(name);
    write_test_image(folder_ / name, ramps(48, 40, 3));
    fuzz(slurp(folder_ / name), 150, ++salt, load);
  }
  fuzz(flat_jpeg(40, 40, {1, 2, 3, 4}), 150, ++salt, load);
  write_test_image(folder_ / "float.tif", ramps(40, 40, 4), {OIIO::TypeDesc::FLOAT});
  fuzz(slurp(folder_ / "float.tif"), 150, ++salt, load);
}

TEST_F(ParserFuzz, ImageHeaders) {
  Mutator mutator(100);
  write_test_image(folder_ / "a.png", ramps(16, 16, 3));
  write_test_image(folder_ / "a.webp", ramps(16, 16, 3));
  const std::string seeds[] = {flat_jpeg(40, 40, {1, 2, 3}), slurp(folder_ / "a.png"),
                               slurp(folder_ / "a.webp")};
  int complete = 0;
  for (int round = 0; round < 6000; ++round) {
    const std::string bytes = mutator.changed(seeds[round % 3]);
    complete += image_is_complete(bytes);
    ASSERT_LE(jpeg_components(bytes), 255);
  }
  EXPECT_GT(complete, 100);
  EXPECT_LT(complete, 5900);
}

TEST_F(ParserFuzz, ChainFiles) {
  {
    ChainCsvWriter writer(folder_ / "chain.csv", {"m", 1, 2, 2, 4, {"a", "b"}});
    for (int i = 0; i < 6; ++i) {
      if (i == 2) writer.adaptation_terminated(0.1, {1, 2});
      writer.append({-1.5 * i, 0.5, 0.1, 1, i == 3, 2.5, {0.25 * i, std::nan("")}});
    }
    writer.close(1, 2);
  }
  fuzz(slurp(folder_ / "chain.csv"), 4000, 200, [](const std::filesystem::path& path) {
    ChainCsvReader reader(path);
    for (const auto& row : reader.read_new()) ASSERT_EQ(row.row.values.size(), reader.header().names.size());
  });
}

TEST_F(ParserFuzz, ParamsFiles) {
  const ParameterTable table{"m", "", {{"a", "", "", {0, 1, -1, 1}}}, {{"b", "", {"x", "y"}}}};
  fuzz(R"({ "a"  :  0.2500000000000000000,   "b" : 1.0000000000000000e0 })", 4000, 300,
       [&](const std::filesystem::path& path) {
         const ParameterValues values = read_params(path, table, {{0}, {0}});
         ASSERT_TRUE(std::abs(values.continuous.at(0)) <= 1);
         ASSERT_TRUE(values.discrete.at(0) == 0 || values.discrete.at(0) == 1);
       });
}

}  // namespace
}  // namespace patina
