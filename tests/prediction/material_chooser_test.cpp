#include "engine/prediction/material_chooser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/io/photo.h"
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
  return renderer.render(values, StructureFeatures::kSide);
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
      const Eigen::VectorXd log_p = chooser.log_probabilities(render_of_prior_draw(renderer, rng));
      EXPECT_NEAR(log_p.array().exp().sum(), 1, 1e-9);
      Eigen::Index first = 0;
      claimed += std::exp(log_p.maxCoeff(&first));
      right += chooser.materials()[static_cast<std::size_t>(first)] == material;
    }
  }
  EXPECT_GT(right, 0.7 * all);
  EXPECT_NEAR(right, claimed, 3 * std::sqrt(0.2 * all));
}

std::string first_of(const MaterialChooser& chooser, const Image& photo) {
  Eigen::Index first = 0;
  chooser.log_probabilities(photo).maxCoeff(&first);
  return chooser.materials()[static_cast<std::size_t>(first)];
}

/// Of all images of a folder, named after their materials ("wood_3.jpg"), so many are told right.
void expect_told_apart(const std::filesystem::path& folder, int all, int least) {
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "There are no images in " << folder << ".";
  const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
  int right = 0, found = 0;
  std::string wrong;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string(), material = name.substr(0, name.find('_'));
    if (!std::ranges::count(material_names(), material)) continue;
    const std::string first = first_of(chooser, load_photo(entry.path()).image);
    ++found;
    if (first == material)
      ++right;
    else
      wrong += name + " is taken for " + first + ". ";
  }
  EXPECT_EQ(found, all);
  EXPECT_GE(right, least) << wrong;
}

TEST(MaterialChooser, TellsFlashPhotographsApart) { expect_told_apart(PATINA_SHARED_DIR "/photos", 9, 8); }

// Models that it was not trained on, of the same materials.
TEST(MaterialChooser, TellsRendersOfThePapersOwnModelsApart) {
  expect_told_apart(PATINA_SHARED_DIR "/reference/renders", 18, 16);
}

TEST(MaterialChooser, SeesNeitherColourNorExposure) {
  const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
  Rng rng(5);
  const Image photo = render_of_prior_draw(Renderer("leather", 3, Capture{}), rng);
  Image other = photo;
  for (std::size_t i = 0; i < other.pixels.size(); i += 3) std::swap(other.pixels[i], other.pixels[i + 2]);
  const Eigen::VectorXd log_p = chooser.log_probabilities(photo);
  EXPECT_LT((chooser.log_probabilities(other) - log_p).cwiseAbs().maxCoeff(), 1e-3);
  for (float& pixel : other.pixels) pixel *= 0.8f;
  EXPECT_LT((chooser.log_probabilities(other) - log_p).cwiseAbs().maxCoeff(), 1);
  for (std::size_t i = 0; i < other.pixels.size(); ++i)  // another structure, though
    other.pixels[i] = photo.pixels[i - i % static_cast<std::size_t>(3 * photo.width)];
  EXPECT_GT((chooser.log_probabilities(other) - log_p).cwiseAbs().maxCoeff(), 3);
}

TEST(MaterialChooser, AnswersForAWallWithoutAFeature) {
  const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
  Image grey(128, 128, 3);
  grey.pixels.assign(grey.pixels.size(), 0.5f);
  EXPECT_TRUE(chooser.log_probabilities(grey).allFinite());
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
  for (const std::string bad : {"", "{}", "[1]", "{\"format\": 1}"}) {
    file.metadata["patina_chooser"] = bad;
    EXPECT_TRUE(refused()) << bad;
  }
  file.metadata["patina_chooser"] = description;
  file.tensors.at("layer2.bias")[0] = std::nan("");
  EXPECT_TRUE(refused());
}

}  // namespace
}  // namespace patina
