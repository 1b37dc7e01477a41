#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/prediction/dense_network.h"
#include "engine/prediction/photo_features.h"
#include "engine/prediction/prediction.h"

namespace patina {

/// A small network that maps a photo to a material's parameters with their uncertainty, after Hu et al. 2019;
/// one a material, trained on the project's own renders (resources/predictors/README.md). Safe to call from
/// several threads.
///
/// The file is .safetensors: feature.mean and feature.sd [n]; layer1, layer2 and layer3, each .weight [out,
/// in] and .bias [out], ReLU between them. Of the outputs the first p are the mean of the coordinates, the
/// next p the logarithms of the diagonal of L, then L's rows below the diagonal, then a logit of every level
/// of every choice. Metadata "patina_predictor" is JSON: {"format": 1, "material", "network_sha256",
/// "parameters":
/// [{"name", "prior", "camera_power"}], "choices": [{"name", "levels"}]}, with the priors it was trained
/// under.
class Predictor {
 public:
  static constexpr int kSide = 128;  ///< pixels a side at which photos are looked at

  /// @throws UserError for a file that is not one, or of another material's, network's or version's make
  static Predictor load(const std::filesystem::path& file, const ParameterTable& table);

  /// @param photo  square, 3 channels, sRGB in [0,1]
  Prediction predict(const Image& photo, const Capture& capture) const;

  /// The same of features that are known.
  Prediction predict(const Eigen::VectorXf& features, const Capture& capture) const;

 private:
  friend class PredictorReader;
  PhotoFeatures features_{kSide};
  ParameterTable table_;  ///< with the priors of its training
  DenseNetwork network_;
};

/// Bounds of the logarithms of L's diagonal, so that no sd is below a 150th of the prior's.
constexpr double kLeastLogPrecision = -3, kMostLogPrecision = 5;

/// The predictor of a material that comes with the program.
std::filesystem::path bundled_predictor(const std::string& material);

}  // namespace patina
