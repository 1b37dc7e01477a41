#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace patina {

struct SafeTensors;

/// Features in, standardised; three dense layers with ReLU between; outputs. Of a .safetensors file the
/// tensors feature.mean and feature.sd [inputs]; layer1, layer2 and layer3, each .weight [out, in] and .bias
/// [out].
class DenseNetwork {
 public:
  /// Features lie at most this many standard deviations from their mean: a photo unlike all renders is taken
  /// for the most extreme of them.
  static constexpr float kFarthestFeature = 4;

  /// @param refuse  called with what is wrong, in half a sentence; throws
  static DenseNetwork read(const SafeTensors& file, Eigen::Index inputs, Eigen::Index outputs,
                           const std::function<void(const std::string&)>& refuse);

  Eigen::VectorXd operator()(const Eigen::VectorXf& features) const;

 private:
  struct Layer {
    Eigen::MatrixXf weight;
    Eigen::VectorXf bias;
  };
  Eigen::VectorXf mean_, sd_;
  std::vector<Layer> layers_;
};

/// exp(logits) over their sum.
Eigen::VectorXd softmax(const Eigen::VectorXd& logits);

}  // namespace patina
