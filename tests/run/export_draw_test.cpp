#include "engine/run/export_draw.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/io/image_file.h"
#include "engine/io/params_json.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class ExportDrawTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    request_.material = "leather";
    request_.z_seed = 4;
    request_.capture = {10, 12};
    request_.resolution = 64;
    request_.values = prior_location(renderer_.table());
    request_.values.discrete = {2, 1};
    request_.values.continuous[1] = 0.123456789;
  }

  std::filesystem::path out() const { return folder_ / "a" / "b"; }
  Image read(const char* name) const { return read_image(out() / name); }

  ExportRequest request_;
  Renderer renderer_{"leather", 4, {10, 12}};
};

TEST_F(ExportDrawTest, ParamsAreTheDrawsOwn) {
  export_draw(request_, out());
  const ParameterValues read =
      read_params(out() / "params.json", renderer_.table(), prior_location(renderer_.table()));
  EXPECT_EQ(read, request_.values);
}

TEST_F(ExportDrawTest, TheRenderIsTheEnginesRender) {
  export_draw(request_, out());
  const Image direct = renderer_.render(request_.values, 64), file = read("render.png");
  ASSERT_EQ(file.pixels.size(), direct.pixels.size());
  for (std::size_t i = 0; i < file.pixels.size(); ++i)
    ASSERT_NEAR(file.pixels[i], direct.pixels[i], 0.51 / 255);
}

TEST_F(ExportDrawTest, TheMapsDecodeToTheSurfaceByTheSidecar) {
  export_draw(request_, out());
  const MaterialMaps maps = renderer_.maps(request_.values, 64);
  const auto sidecar = nlohmann::json::parse(slurp(out() / "maps.json"));
  const Image color = read("base_color.png"), normal = read("normal_gl.png"), rough = read("roughness.png"),
              height = read("height.png");
  const double black = sidecar["height_cm"]["black"], white = sidecar["height_cm"]["white"];
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      const float encoded = color.at(row, column, 1);
      const double linear = encoded <= 0.04045f ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
      ASSERT_NEAR(linear, maps.base_color.at(row, column, 1), 1e-4);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(2 * normal.at(row, column, c) - 1, maps.normal.at(row, column, c), 4e-5);
      ASSERT_NEAR(rough.at(row, column, 0), maps.lobes[0].roughness.at(row, column, 0), 2e-5);
      ASSERT_NEAR(black + (white - black) * height.at(row, column, 0), maps.height.at(row, column, 0),
                  (white - black) * 2e-5);
    }
  EXPECT_EQ(sidecar["size_cm"], 10.0);
  EXPECT_EQ(sidecar["material"], "leather");
}

TEST_F(ExportDrawTest, UpIsGreenAndRightIsRed) {
  request_.values.continuous[9] = 0.025;  // grain, so that there are slopes at all
  export_draw(request_, out());
  const MaterialMaps maps = renderer_.maps(request_.values, 64);
  const Image normal = read("normal_gl.png");
  // Height falls towards where the normal leans: correlate the slope in x and y (up) with red and green.
  double right = 0, up = 0;
  for (int row = 1; row < 63; ++row)
    for (int column = 1; column < 63; ++column) {
      right -= (maps.height.at(row, column + 1, 0) - maps.height.at(row, column - 1, 0)) *
               (normal.at(row, column, 0) - 0.5);
      up -= (maps.height.at(row - 1, column, 0) - maps.height.at(row + 1, column, 0)) *
            (normal.at(row, column, 1) - 0.5);
    }
  EXPECT_GT(right, 0);
  EXPECT_GT(up, 0);
}

TEST_F(ExportDrawTest, ATileIsTheMapsThatRepeatAndTheSidecarSaysHowLargeTheyAre) {
  request_.tile = true;
  export_draw(request_, out());
  const MaterialMaps tile = renderer_.tile(request_.values, 64);
  const Image rough = read("roughness.png");
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
      ASSERT_NEAR(rough.at(row, column, 0), tile.lobes[0].roughness.at(row, column, 0), 2e-5);
  const auto sidecar = nlohmann::json::parse(slurp(out() / "maps.json"));
  const double scale = request_.values.continuous[*renderer_.table().find_continuous("scale")];
  EXPECT_NEAR(sidecar["size_cm"], 10 / scale, 1e-9);
  EXPECT_EQ(sidecar["sample_size_cm"], 10.0);
  EXPECT_EQ(sidecar["tile"], true);
}

TEST_F(ExportDrawTest, WritesExactlyTheFilesThatItNames) {
  for (const MapFormat format : {MapFormat::png8, MapFormat::png16, MapFormat::exr})
    for (const NormalConvention normals : {NormalConvention::opengl, NormalConvention::directx}) {
      request_.format = format;
      request_.normals = normals;
      std::filesystem::remove_all(out());
      export_draw(request_, out());
      std::set<std::string> named, written;
      for (const ExportedFile& file : exported_files(format, normals)) named.insert(file.name);
      for (const auto& entry : std::filesystem::directory_iterator(out()))
        written.insert(entry.path().filename());
      EXPECT_EQ(written, named);
      const auto spaces = nlohmann::json::parse(slurp(out() / "maps.json"))["color_space"];
      EXPECT_EQ(spaces.size(), named.size() - 2) << "all but the two texts";
    }
}

TEST_F(ExportDrawTest, OpenExrHoldsLinearColoursAndHeightsInCentimetres) {
  request_.format = MapFormat::exr;
  export_draw(request_, out());
  const MaterialMaps maps = renderer_.maps(request_.values, 64);
  const Image color = read("base_color.exr"), height = read("height.exr");
  for (int row = 0; row < 64; row += 7)
    for (int column = 0; column < 64; ++column) {
      const float wanted = maps.base_color.at(row, column, 1);
      ASSERT_NEAR(color.at(row, column, 1), wanted, 1e-3 * wanted);
      ASSERT_EQ(height.at(row, column, 0), maps.height.at(row, column, 0));
    }
}

TEST_F(ExportDrawTest, DirectXNormalsAreOpenGlsWithGreenTurnedOver) {
  request_.values.continuous[9] = 0.025;
  export_draw(request_, out());
  request_.normals = NormalConvention::directx;
  export_draw(request_, out());
  const Image gl = read("normal_gl.png"), dx = read("normal_dx.png");
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      ASSERT_EQ(gl.at(row, column, 0), dx.at(row, column, 0));
      ASSERT_NEAR(gl.at(row, column, 1) + dx.at(row, column, 1), 1, 2e-5);
      ASSERT_EQ(gl.at(row, column, 2), dx.at(row, column, 2));
    }
}

TEST_F(ExportDrawTest, TheSidecarSaysWhereTheDrawComesFrom) {
  request_.origin = {"oak.jpg", "0123", "", "chain 2, step 153"};
  export_draw(request_, out());
  const auto sidecar = nlohmann::json::parse(slurp(out() / "maps.json"));
  EXPECT_EQ(sidecar["origin"],
            (nlohmann::json{{"photo", "oak.jpg"}, {"photo_sha256", "0123"}, {"draw", "chain 2, step 153"}}));
}

TEST_F(ExportDrawTest, RefusesWhatCannotBe) {
  ExportRequest bad = request_;
  bad.resolution = 0;
  EXPECT_NE(user_error([&] { export_draw(bad, out()); }).find("resolution"), std::string::npos);
  bad.resolution = 5000;
  EXPECT_NE(user_error([&] { export_draw(bad, out()); }), "");
  bad = request_;
  bad.material = "nosuch";
  EXPECT_NE(user_error([&] { export_draw(bad, out()); }).find("nosuch"), std::string::npos);
  bad.material = "translucent";
  bad.values = prior_location(Renderer("translucent", 1, {}).table());
  bad.tile = true;
  EXPECT_NE(user_error([&] { export_draw(bad, out()); }).find("tile of translucent"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out()));
  EXPECT_NE(user_error([&] { export_draw(request_, file("a_file", "x")); }), "");
}

}  // namespace
}  // namespace patina
