#include "engine/material/prior_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/registry.h"

namespace patina {
namespace {

constexpr const char* kGood = R"({"material": "toy", "description": "A toy", "parameters": [
  {"name": "light", "unit": "", "description": "Lamp", "prior": [1, 2, 0, 5]},
  {"name": "iSigma", "unit": "cm", "description": "Reach", "prior": [3.5, 1, 1, 9]}],
  "choices": [{"name": "cells", "description": "Which", "levels": ["a", "b"]}]})";

class PriorFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ParameterTable read(const std::string& text) const {
    std::ofstream(file()) << text;
    return read_parameter_table(file(), {{"light", "iSigma"}, {{"cells", 2}}});
  }

  /// The good file with its first `from` replaced.
  std::string with(const std::string& from, const std::string& to) const {
    std::string text = kGood;
    return text.replace(text.find(from), from.size(), to);
  }

  /// The good file with one more field of its first parameter.
  std::string with_field_of_light(const std::string& field, const std::string& value) const {
    return with("[1, 2, 0, 5]", "[1, 2, 0, 5], \"" + field + "\": " + value);
  }

  void expect_refusal(const std::string& text, const std::string& field) const {
    try {
      read(text);
      FAIL() << "accepted: " << text;
    } catch (const UserError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("toy.json"), std::string::npos) << what;
      EXPECT_NE(what.find(field), std::string::npos) << what;
    }
  }

  std::filesystem::path file() const { return folder_ / "toy.json"; }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  ("patina-prior-" + std::to_string(::getpid()) + "-" +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(PriorFile, SummaryIsGramUnlessTheFileSaysOtherwise) {
  EXPECT_EQ(read(kGood).summary, "gram");
  EXPECT_EQ(read(with(R"("choices")", R"("summary": "bands", "choices")")).summary, "bands");
  expect_refusal(with(R"("choices")", R"("summary": 3, "choices")"), "summary");
}

TEST_F(PriorFile, GoodOneIsReadAsItStands) {
  const ParameterTable table = read(kGood);
  EXPECT_EQ(table.material, "toy");
  ASSERT_EQ(table.continuous.size(), 2u);
  EXPECT_EQ(table.continuous[1].name, "iSigma");
  EXPECT_EQ(table.continuous[1].unit, "cm");
  EXPECT_EQ(table.continuous[1].prior, (TruncatedNormal{3.5, 1, 1, 9}));
  ASSERT_EQ(table.discrete.size(), 1u);
  EXPECT_EQ(table.discrete[0].levels, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.find_continuous("iSigma"), 1u);
  EXPECT_EQ(table.find_continuous("isigma"), std::nullopt);
  EXPECT_EQ(table.find_discrete("cells"), 0u);
}

TEST_F(PriorFile, APriorMayGrowWithTheCamerasDistance) {
  EXPECT_EQ(read(kGood).continuous[0].camera_power, 0);
  EXPECT_EQ(read(with_field_of_light("camera_power", "2")).continuous[0].camera_power, 2);
  expect_refusal(with_field_of_light("camera_power", "\"2\""), "'light'");
  expect_refusal(with_field_of_light("camera_power", "40"), "'light'");
}

TEST_F(PriorFile, WhatAParameterScalesMayBeAbsentSomewhereInItsRange) {
  EXPECT_EQ(read(kGood).continuous[0].off, std::nullopt);
  EXPECT_EQ(read(with_field_of_light("off", "0")).continuous[0].off, 0);
  expect_refusal(with_field_of_light("off", "-1"), "'light'");
  expect_refusal(with_field_of_light("off", "null"), "'light'");
}

TEST_F(PriorFile, NotJsonIsRefused) {
  expect_refusal("", "JSON");
  expect_refusal("[1, 2]", "JSON");
  expect_refusal(std::string(kGood).substr(0, 150), "JSON");
  expect_refusal(with("2, 0, 5", "1e999, 0, 5"), "JSON");
}

TEST_F(PriorFile, MissingOrMistypedFieldsAreRefusedByName) {
  expect_refusal(with("\"description\": \"A toy\"", "\"description\": 3"), "'description'");
  expect_refusal(with("\"parameters\"", "\"Parameters\""), "'parameters'");
  expect_refusal(with("\"choices\"", "\"choice\""), "'choices'");
  expect_refusal(with("\"unit\": \"\"", "\"units\": \"\""), "'unit'");
  expect_refusal(with("{\"name\": \"light\"", "3, {\"name\": \"light\""), "'name'");
  expect_refusal(with("\"a\"", "7"), "'cells'");
  expect_refusal(with("\"material\": \"toy\"", "\"material\": \"leather\""), "'leather'");
}

TEST_F(PriorFile, ImpossiblePriorsAreRefusedByName) {
  expect_refusal(with("1, 2, 0, 5", "1, 2, 0"), "'light'");
  expect_refusal(with("1, 2, 0, 5", "1, \"2\", 0, 5"), "'light'");
  expect_refusal(with("1, 2, 0, 5", "1, 0, 0, 5"), "'light'");
  expect_refusal(with("1, 2, 0, 5", "1, -2, 0, 5"), "'light'");
  expect_refusal(with("1, 2, 0, 5", "1, 2, 5, 5"), "'light'");
}

TEST_F(PriorFile, WhatTheCodeDoesNotReadIsRefused) {
  expect_refusal(with("\"light\"", "\"iSigma\""), "twice");
  expect_refusal(with("\"light\"", "\"lamp\""), "'lamp'");
  expect_refusal(with("\"cells\"", "\"noise\""), "'noise'");
  expect_refusal(with("\"b\"", "\"b\", \"c\""), "2 levels");
  expect_refusal(with("\"a\", \"b\"", ""), "'cells'");
}

TEST(Registry, KnowsItsMaterialsAndTheirTables) {
  for (const std::string& name : material_names()) {
    const ParameterTable table = material_table(name);
    EXPECT_EQ(table.material, name);
    for (const Parameter& parameter : table.continuous) EXPECT_FALSE(parameter.description.empty());
    const ParameterValues location = prior_location(table);
    ASSERT_EQ(location.continuous.size(), table.continuous.size());
    for (std::size_t i = 0; i < location.continuous.size(); ++i) {
      EXPECT_GE(location.continuous[i], table.continuous[i].prior.low);
      EXPECT_LE(location.continuous[i], table.continuous[i].prior.high);
    }
  }
}

TEST(Registry, AnUnknownMaterialIsRefusedWithTheKnownOnes) {
  try {
    make_material("velvet");
    FAIL();
  } catch (const UserError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("velvet"), std::string::npos);
    EXPECT_NE(what.find("leather"), std::string::npos);
  }
}

}  // namespace
}  // namespace patina
