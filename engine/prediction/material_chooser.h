#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/prediction/dense_network.h"
#include "engine/prediction/structure_features.h"

namespace patina {

/// A network that was shown renders of draws of every material's prior and learned which was which: its
/// outputs are the log evidences of the materials for what it sees of a photo, its structure (not light,
/// colour or size), up to a constant, with irregularities, capture and noise averaged over (amortised model
/// comparison; Radev et al. 2021, "Amortized Bayesian model comparison with evidential deep learning"). Takes
/// milliseconds. Safe to call from several threads.
///
/// The file is a DenseNetwork's, an output a material. Metadata "patina_chooser" is JSON: {"format": 2,
/// "network_sha256", "materials": [...]}.
class MaterialChooser {
 public:
  /// @throws UserError for a file that is not one, or was made with another bundled network
  static MaterialChooser load(const std::filesystem::path& file);

  const std::vector<std::string>& materials() const { return materials_; }

  /// Log probabilities of materials(), all equally likely beforehand.
  /// @param photo  square, 3 channels, sRGB in [0,1]
  Eigen::VectorXd log_probabilities(const Image& photo) const;

 private:
  StructureFeatures features_;
  DenseNetwork network_;
  std::vector<std::string> materials_;
};

/// The one that comes with the program.
std::filesystem::path bundled_chooser();

}  // namespace patina
