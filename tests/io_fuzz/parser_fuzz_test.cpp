// Photos, chain files and parameter files: the fuzz of parser_fuzz.h.
#include <algorithm>
#include <cmath>

#include "engine/io/chain_csv.h"
#include "engine/io/image_file.h"
#include "engine/io/image_format.h"
#include "engine/io/params_json.h"
#include "engine/io/photo.h"
#include "tests/io/images.h"
#include "tests/io_fuzz/parser_fuzz.h"

namespace patina {
namespace {

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
    writer.close();
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
