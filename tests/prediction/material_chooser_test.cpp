#include "engine/prediction/material_chooser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/prior_transform.h"
#include "engine/sampling/rng.h"
#include "engine/summary/safetensors.h"

namespace patina {
namespace {

constexpr int kRenders = 12;  // of each material

Image render_of_prior_draw(const Renderer& renderer, Rng& rng) {
  ParameterValues values = prior_location(renderer.table());
  for (std::size_t i = 0; i < values.continuous.size(); ++i)
    values.continuous[i] = PriorTransform(renderer.table().continuous[i].prior).value(rng.normal());
  for (std::size_t i = 0; i < values.discrete.size(); ++i)
    values.discrete[i] = rng.below(static_cast<int>(renderer.table().discrete[i].levels.size()));
  return renderer.render(values, 128);
}

TEST(MaterialChooser, RecognisesMostRendersAndIsAsSureAsItIsRight) {
  const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
  ASSERT_EQ(chooser.materials(), material_names());
  Rng rng(8);
  int right = 0, all = 0;
  double claimed = 0;
  for (const std::string& material : material_names()) {
    const Renderer renderer(material, 77, Capture{});
    for (int i = 0; i < kRenders; ++i, ++all) {
      const Eigen::VectorXd log_p = chooser.log_probabilities(render_of_prior_draw(renderer, rng), Capture{});
      EXPECT_NEAR(log_p.array().exp().sum(), 1, 1e-9);
      Eigen::Index first = 0;
      claimed += std::exp(log_p.maxCoeff(&first));
      right += chooser.materials()[static_cast<std::size_t>(first)] == material;
    }
  }
  EXPECT_GT(right, 0.7 * all);
  EXPECT_NEAR(right, claimed, 3 * std::sqrt(0.2 * all));
}

TEST(MaterialChooser, AnswersForAWallWithoutAFeature) {
  const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
  Image grey(128, 128, 3);
  grey.pixels.assign(grey.pixels.size(), 0.5f);
  EXPECT_TRUE(chooser.log_probabilities(grey, Capture{}).allFinite());
}

TEST(MaterialChooser, WhatIsNoneIsRefused) {
  SafeTensors file = read_safetensors(bundled_chooser());
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "chooser.safetensors";
  const std::string description = file.metadata.at("patina_chooser");
  const auto refused = [&] {
    write_safetensors(path, file);
    try {
      MaterialChooser::load(path);
    } catch (const UserError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused());
  for (const std::string bad : {"", "{}", "[1]", "{\"format\": 2}"}) {
    file.metadata["patina_chooser"] = bad;
    EXPECT_TRUE(refused()) << bad;
  }
  file.metadata["patina_chooser"] = description;
  file.tensors.at("layer2.bias")[0] = std::nan("");
  EXPECT_TRUE(refused());
}

}  // namespace
}  // namespace patina
