#include "engine/io/params_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/io/folder_test.h"

namespace patina {
namespace {

const ParameterTable kTable{
    "plush",
    "for tests",
    {{"light", "", "", {1500, 300, 100, 3000}}, {"rough", "", "", {0.3, 0.2, 0.1, 0.7}}},
    {{"cells", "", {"few", "some", "many"}}}};
const ParameterValues kDefaults{{1500, 0.3}, {1}};

class ParamsJson : public FolderTest {
 protected:
  ParameterValues read(const std::string& text) {
    return read_params(file("p.json", text), kTable, kDefaults);
  }
  std::string refusal(const std::string& text) {
    return user_error([&] { read(text); });
  }
};

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST_F(ParamsJson, ReadsBackExactlyWhatItWrote) {
  const ParameterValues values{{100 + 1.0 / 3, std::nextafter(0.1, 1)}, {2}};
  EXPECT_EQ(read(params_to_json(kTable, values)), values);
}

TEST_F(ParamsJson, IsPlainJsonInTheTablesOrder) {
  const std::string text = params_to_json(kTable, kDefaults);
  const auto json = nlohmann::ordered_json::parse(text);
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"light", "rough", "cells"}));
  EXPECT_EQ(json["light"], 1500.0);
  EXPECT_TRUE(json["cells"].is_number_integer());
}

TEST_F(ParamsJson, NamesThatAreNotInTheFileKeepTheirValue) {
  EXPECT_EQ(read("{}"), kDefaults);
  EXPECT_EQ(read(R"({"rough": 0.7})"), (ParameterValues{{1500, 0.7}, {1}}));
  EXPECT_EQ(read(R"({"cells": 2.0, "light": 100})"), (ParameterValues{{100, 0.3}, {2}}));
}

TEST_F(ParamsJson, WhatIsNoJsonObjectIsRefused) {
  for (const char* text : {"", "{", "[1, 2]", "3", "null", "{\"light\": NaN}", "{\"light\": 1e999}",
                           "{light: 1}", "{\"light\": 200}}", "\xFF\xFE{}", "{\"\xC3\x28\": 1}"})
    EXPECT_TRUE(has(refusal(text), "p.json is not a params file")) << text;
  EXPECT_NE(refusal(std::string(900'000, '[')), "");
  EXPECT_NE(refusal(std::string(2 << 20, ' ') + "{}"), "");
  EXPECT_NE(user_error([&] { read_params(folder_ / "none.json", kTable, kDefaults); }), "");
}

TEST_F(ParamsJson, AnUnknownNameIsRefusedWithTheKnownOnes) {
  const std::string message = refusal(R"({"nosuch": 1})");
  EXPECT_TRUE(has(message, "'nosuch'") && has(message, "light, rough, cells")) << message;
  const ParameterTable choices{"choices", "", {}, kTable.discrete};
  ParameterValues values{{}, {0}};
  EXPECT_TRUE(has(user_error([&] { set_parameter(choices, "x", 1, values); }), "it has cells."));
}

TEST_F(ParamsJson, ValuesThatAreNoNumbersAreRefused) {
  for (const char* value : {"\"many\"", "true", "null", "[1]", "{\"a\": 1}"})
    EXPECT_TRUE(has(refusal(std::string("{\"light\": ") + value + "}"), "light")) << value;
}

TEST_F(ParamsJson, ValuesOutOfRangeAreRefusedWithTheRange) {
  EXPECT_TRUE(has(refusal(R"({"light": 1e99})"), "100 to 3000"));
  EXPECT_TRUE(has(refusal(R"({"rough": 0.7000000000000001})"), "0.7000000000000001"))
      << "the value is not named";
  EXPECT_NE(refusal(R"({"rough": -0.2})"), "");
  for (const char* value : {"3", "-1", "0.5", "1e99"})
    EXPECT_TRUE(has(refusal(std::string("{\"cells\": ") + value + "}"), "whole number from 0 to 2")) << value;
  ParameterValues values = kDefaults;
  for (const char* name : {"light", "cells"})
    EXPECT_NE(user_error([&] { set_parameter(kTable, name, std::nan(""), values); }), "");
  EXPECT_EQ(values, kDefaults) << "a refused value was set";
}

}  // namespace
}  // namespace patina
