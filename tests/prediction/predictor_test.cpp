#include "engine/prediction/predictor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/sampling/rng.h"
#include "resources/predictors/photo_examples.h"
#include "resources/predictors/predictor_loss.h"

namespace patina {
namespace {

constexpr std::uint64_t kFresh = 4711;  // no predictor was trained with it
const Capture kAnyCapture{};

Eigen::VectorXf row(const at::Tensor& matrix, std::int64_t i) {
  return Eigen::Map<const Eigen::VectorXf>(matrix.data_ptr<float>() + i * matrix.size(1), matrix.size(1));
}

std::vector<int> levels_of(const PhotoExamples& photos, std::int64_t i) {
  const std::int64_t choices = photos.levels.size(1);
  const std::int64_t* first = photos.levels.data_ptr<std::int64_t>() + i * choices;
  return {first, first + choices};
}

double log_density(const Predictor& predictor, const PhotoExamples& photos, std::int64_t seen,
                   std::int64_t truth) {
  return predictor.predict(row(photos.features, seen), kAnyCapture)
      .log_density(row(photos.coordinates, truth).cast<double>(), levels_of(photos, truth));
}

double prior_log_density(const ParameterTable& table, const PhotoExamples& photos, std::int64_t truth) {
  const Eigen::VectorXd u = row(photos.coordinates, truth).cast<double>();
  double log_density = -u.squaredNorm() / 2 - static_cast<double>(u.size()) / 2 * std::log(2 * M_PI);
  for (const DiscreteParameter& choice : table.discrete)
    log_density -= std::log(static_cast<double>(choice.levels.size()));
  return log_density;
}

/// Made once: a surface's maps take a while.
const PhotoExamples& photos_of(const std::string& material, int count) {
  static std::map<std::pair<std::string, int>, PhotoExamples> known;
  const auto key = std::pair(material, count);
  if (!known.contains(key)) known.emplace(key, simulate_photos(material, count, kFresh, 2));
  return known.at(key);
}

class PredictorFile : public testing::Test {
 protected:
  void SetUp() override {
    photos_ = photos_of("leather", 6);
    file_ = std::filesystem::path(testing::TempDir()) / "predictor.safetensors";
    contents_ = predictor_file(table_, student());
  }

  DenseStudent student() const { return {photos_.features, 8, predictor_outputs(table_), 1}; }

  void expect_refusal(const std::string& part) {
    write_safetensors(file_, contents_);
    try {
      Predictor::load(file_, table_);
      FAIL() << "it was taken";
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  void replace_in_description(const std::string& from, const std::string& to) {
    std::string& text = contents_.metadata.at("patina_predictor");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  }

  ParameterTable table_ = material_table("leather");
  PhotoExamples photos_;
  std::filesystem::path file_;
  SafeTensors contents_;
};

TEST_F(PredictorFile, TheTrainersLossAndThePredictorsDensityAreOneFunction) {
  const DenseStudent student = this->student();
  write_safetensors(file_, contents_);
  const Predictor predictor = Predictor::load(file_, table_);
  double sum = 0;
  for (std::int64_t i = 0; i < photos_.features.size(0); ++i) sum += log_density(predictor, photos_, i, i);
  const at::Tensor outputs = student(student.standardised(photos_.features));
  const double loss = predictor_loss(table_, outputs, photos_.coordinates, photos_.levels).item<double>();
  EXPECT_NEAR(loss, -sum / static_cast<double>(photos_.features.size(0)), 1e-3);
}

TEST_F(PredictorFile, AnotherMaterialsIsRefused) {
  write_safetensors(file_, contents_);
  EXPECT_THROW(Predictor::load(file_, material_table("bump")), UserError);
}

TEST_F(PredictorFile, OneMadeWithAnotherNetworkIsRefused) {
  replace_in_description("\"network_sha256\":\"", "\"network_sha256\":\"0");
  expect_refusal("another bundled network");
}

TEST_F(PredictorFile, OneOfAMaterialThatHasChangedIsRefused) {
  replace_in_description("\"light\"", "\"lamp\"");
  expect_refusal("other parameters");
}

TEST_F(PredictorFile, AnImpossiblePriorIsRefused) {
  replace_in_description("\"camera_power\":2", "\"camera_power\":200");
  expect_refusal("impossible");
}

TEST_F(PredictorFile, NumbersThatAreNoneAreRefused) {
  contents_.tensors.at("layer2.weight")[0][0] = std::nan("");
  expect_refusal("not a number");
}

TEST_F(PredictorFile, AMissingLayerIsRefused) {
  contents_.tensors.erase("layer3.bias");
  expect_refusal("lacks layer3.bias");
}

TEST_F(PredictorFile, LayersThatDoNotFitAreRefused) {
  contents_.tensors.at("layer1.weight") = contents_.tensors.at("layer1.weight").narrow(1, 0, 40).contiguous();
  expect_refusal("another size");
}

TEST_F(PredictorFile, WhatIsNoPredictorIsRefused) {
  contents_.metadata.clear();
  expect_refusal("does not say");
}

/// A predictor that comes with the program, and photos that it has not seen.
class BundledPredictor : public testing::TestWithParam<std::string> {
 protected:
  static constexpr int kPhotos = 60;
  ParameterTable table_ = material_table(GetParam());
  PhotoExamples photos_ = photos_of(GetParam(), kPhotos);
  Predictor predictor_ = Predictor::load(bundled_predictor(GetParam()), table_);
};

TEST_P(BundledPredictor, KnowsMoreOfAPhotoThanThePriorAndNothingFromAnother) {
  double gain = 0, squares = 0, from_another = 0;
  for (std::int64_t i = 0; i < kPhotos; ++i) {
    const double prior = prior_log_density(table_, photos_, i);
    const double own = log_density(predictor_, photos_, i, i) - prior;
    gain += own / kPhotos;
    squares += own * own / kPhotos;
    from_another += (log_density(predictor_, photos_, (i + 1) % kPhotos, i) - prior) / kPhotos;
  }
  const double error = std::sqrt((squares - gain * gain) / kPhotos);
  EXPECT_GT(gain, 1 + 2 * error);
  EXPECT_LT(from_another, -1);
}

TEST_P(BundledPredictor, SaysHowFarItMayBeWrong) {
  int inside = 0, all = 0;
  for (std::int64_t i = 0; i < kPhotos; ++i) {
    const Prediction prediction = predictor_.predict(row(photos_.features, i), kAnyCapture);
    const Eigen::VectorXd error = row(photos_.coordinates, i).cast<double>() - prediction.mean;
    const Eigen::VectorXd sds = prediction.deviations();
    for (Eigen::Index k = 0; k < error.size(); ++k, ++all) inside += std::abs(error[k]) < 1.645 * sds[k];
  }
  const double share = static_cast<double>(inside) / all;
  EXPECT_GT(share, 0.82);
  EXPECT_LT(share, 0.96);
}

TEST_P(BundledPredictor, DrawsAsItSaysItDoes) {
  const Prediction prediction = predictor_.predict(row(photos_.features, 0), kAnyCapture);
  constexpr int kDraws = 4000;
  Rng rng(3);
  const Eigen::VectorXd sds = prediction.deviations();
  EXPECT_EQ(prediction.likeliest().continuous.size(), table_.continuous.size());
  std::vector<int> first_levels;
  for (int i = 0; i < kDraws; ++i) {
    const ParameterValues values = prediction.draw(rng);
    for (std::size_t k = 0; k < values.continuous.size(); ++k) {
      const TruncatedNormal& prior = prediction.table.continuous[k].prior;
      ASSERT_GE(values.continuous[k], prior.low);
      ASSERT_LE(values.continuous[k], prior.high);
    }
    if (!values.discrete.empty()) first_levels.push_back(values.discrete[0]);
  }
  if (first_levels.empty()) return;
  const double expected = prediction.level_probabilities[0][0];
  const double share =
      static_cast<double>(std::ranges::count(first_levels, 0)) / static_cast<double>(first_levels.size());
  EXPECT_NEAR(share, expected, 4 * std::sqrt(expected * (1 - expected) / kDraws) + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(AllMaterials, BundledPredictor, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace patina
