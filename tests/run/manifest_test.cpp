#include "engine/run/manifest.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

class ManifestTest : public FolderTest {
 protected:
  static Manifest full() {
    Manifest m;
    m.program = "patina 9.9";
    m.settings.material = "leather";
    m.settings.kernel = "nuts";
    m.settings.metric = "diagonal";
    m.settings.discrete = "single";
    m.settings.errors = "calibrated";
    m.errors = "calibrated";
    m.warmup = 150;
    m.settings.precision = "bfloat16";
    m.settings.device = "cuda";
    m.settings.temper = 8;
    m.settings.network = "/a b/net\"work.safetensors";
    m.settings.refresh = 0.3;
    m.settings.warmup = 400;
    m.settings.seed = std::numeric_limits<std::uint64_t>::max();
    m.settings.fixed = {{"light", 0.1 + 0.2}};
    m.settings.priors = {{"rough", {0.4, 0.1, 0.2, 0.6}}};
    m.table.material = "leather";
    m.table.continuous = {{"light", "", "intensity", {1500, 100, 0, 2500}},
                          {"rough", "", "", {0.4, 0.1, 0.2, 0.6}}};
    m.table.discrete = {{"cells", "which", {"a", "b"}}};
    m.photo_warnings = {"not a number in 12 pixels"};
    m.gram_sigma = 0.05;
    m.mean_sigma = 0.02;
    m.phase = RunPhase::failed;
    m.reason = "no memory";
    m.settings.stop = {1.5, 400, 1.01};
    m.seconds = {0.1 + 0.2, {1, 2}, {3, 4.5}};
    m.photo_fit = PhotoFit{1.75, 1.0 / 301, 2.5};
    m.evidence = StopEvidence{1200, "rough", 123.456, "light", 1.0123};
    m.map = MapPoint{{{1.0 / 3, 0.25}, {1}}, -12.345678901234567};
    m.basins = {*m.map, MapPoint{{{2.0 / 3, 0.125}, {0}}, -23.5}};
    return m;
  }

  Manifest read(const std::string& text) const {
    file("run.json", text);
    return read_manifest(folder_);
  }
};

TEST_F(ManifestTest, UnknownNamesAndAFitThatCannotBeAreDamage) {
  const auto with = [](const char* pointer, const Json& value) {
    Json json = Json::parse(to_json(full()));
    json[Json::json_pointer(pointer)] = value;
    return json.dump();
  };
  EXPECT_THROW(read(with("/settings/errors", "guessed")), UserError);
  EXPECT_THROW(read(with("/settings/errors", 3)), UserError);
  EXPECT_THROW(read(with("/settings/precision", "float8")), UserError);
  EXPECT_THROW(read(with("/settings/device", "abacus")), UserError);
  EXPECT_THROW(read(with("/photo_fit/widening", 0.5)), UserError);
  EXPECT_THROW(read(with("/photo_fit/p", 2)), UserError);
  EXPECT_NO_THROW(read(with("/photo_fit", nullptr)));
}

TEST_F(ManifestTest, APriorThatNoDrawCanComeFromIsDamage) {
  Manifest manifest = full();
  manifest.table.continuous.front().prior = {0, 0.01, 5, 6};
  EXPECT_NE(user_error([&] { read(to_json(manifest)); }).find("prior"), std::string::npos);
}

TEST_F(ManifestTest, WithoutErrorsPrecisionAndDeviceIsOfTheFirstOnes) {
  Json json = Json::parse(to_json(full()));
  json["settings"].erase("errors");
  json["settings"].erase("precision");
  json["settings"].erase("device");
  json.erase("photo_fit");
  const Manifest m = read(json.dump());
  EXPECT_EQ(m.settings.errors, "paper");
  EXPECT_EQ(m.settings.precision, "float32");
  EXPECT_EQ(m.settings.device, "cpu");
  EXPECT_FALSE(m.photo_fit);
}

TEST_F(ManifestTest, ReadsBackEveryFieldExactly) {
  const Manifest m = full(), r = read(to_json(m));
  EXPECT_EQ(to_json(r), to_json(m));
  EXPECT_EQ(r.settings.network, m.settings.network);
  EXPECT_EQ(r.settings.seed, m.settings.seed);
  EXPECT_EQ(r.settings.errors, m.settings.errors);
  EXPECT_EQ(r.settings.precision, m.settings.precision);
  EXPECT_EQ(r.settings.device, m.settings.device);
  EXPECT_EQ(r.settings.fixed, m.settings.fixed);
  EXPECT_EQ(r.settings.priors, m.settings.priors);
  EXPECT_EQ(r.table.continuous[1].prior, m.table.continuous[1].prior);
  EXPECT_EQ(r.settings.stop, m.settings.stop);
  EXPECT_EQ(r.evidence, m.evidence);
  EXPECT_EQ(r.phase, m.phase);
  ASSERT_TRUE(r.map);
  EXPECT_EQ(r.map->values, m.map->values);
  EXPECT_EQ(r.map->lp, m.map->lp);
  ASSERT_EQ(r.basins.size(), 2u);
  EXPECT_EQ(r.basins[1].values, m.basins[1].values);
  EXPECT_EQ(r.basins[1].lp, -23.5);
}

TEST_F(ManifestTest, ARunFromBeforeThereWereLaddersHasNone) {
  Json older = Json::parse(to_json(full()));
  EXPECT_EQ(read(older.dump()).settings.temper, 8);
  older["settings"].erase("temper");
  EXPECT_EQ(read(older.dump()).settings.temper, 0);
}

TEST_F(ManifestTest, AMapWithoutDensityIsNotAMapAtZero) {
  Manifest m = full();
  m.map->lp = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(read(to_json(m)).map->lp, m.map->lp);
}

/// Every path to a value below `json`, objects themselves included.
void collect_paths(const Json& json, const Json::json_pointer& here, std::vector<Json::json_pointer>& paths) {
  for (const auto& [key, value] : json.items()) {
    paths.push_back(here / key);
    if (value.is_structured()) collect_paths(value, here / key, paths);
  }
}

TEST_F(ManifestTest, NoFieldOfAWrongKindIsBelievedOrCrashes) {
  const Json good = Json::parse(to_json(full()));
  std::vector<Json::json_pointer> paths;
  collect_paths(good, Json::json_pointer(), paths);
  ASSERT_GT(paths.size(), 50u);
  int refused = 0;
  for (const auto& path : paths)
    for (const Json& wrong :
         {Json(nullptr), Json("text"), Json(-1), Json(1e300), Json::array({1}), Json::object()}) {
      Json bad = good;
      bad[path] = wrong;
      refused += !user_error([&] { read(bad.dump()); }).empty();
    }
  // Some replacements are good values (an empty list, another number): most are not.
  EXPECT_GT(refused, static_cast<int>(paths.size()) * 3);
}

TEST_F(ManifestTest, EveryMissingFieldIsRefusedByName) {
  const Json good = Json::parse(to_json(full()));
  for (const auto& [key, value] : good.items()) {
    const bool of_newer_runs = key == "seconds" || key == "evidence" || key == "basins" || key == "alarms" ||
                               key == "photo_fit" || key == "errors" || key == "warmup";
    if (of_newer_runs) continue;
    Json bad = good;
    bad.erase(key);
    EXPECT_NE(user_error([&] { read(bad.dump()); }).find("'" + key + "' is missing"), std::string::npos);
  }
}

TEST_F(ManifestTest, NewerFormatsAndNoJsonAreRefused) {
  Json newer = Json::parse(to_json(full()));
  newer["format"] = kRunFormat + 1;
  EXPECT_NE(user_error([&] { read(newer.dump()); }).find("newer"), std::string::npos);
  for (const char* text : {"", "{", "[]", "null", "\xFF\xD8\xFF", "{\"format\": 2"})
    EXPECT_NE(user_error([&] { read(text); }), "") << text;
}

}  // namespace
}  // namespace patina
