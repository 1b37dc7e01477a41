#include "engine/prediction/dense_network.h"

#include <ATen/core/Tensor.h>
#include <ATen/ops/isfinite.h>

#include "engine/summary/safetensors.h"

namespace patina {
namespace {

/// Takes tensors out of a file, each checked before it is believed.
struct Reader {
  const SafeTensors& file;
  const std::function<void(const std::string&)>& refuse;

  at::Tensor tensor(const std::string& name, std::int64_t dimensions) const {
    const auto found = file.tensors.find(name);
    if (found == file.tensors.end() || found->second.dim() != dimensions) refuse("it lacks " + name);
    if (!at::isfinite(found->second).all().item<bool>()) refuse(name + " holds what is not a number");
    return found->second;
  }

  Eigen::VectorXf vector(const std::string& name, Eigen::Index size) const {
    const at::Tensor values = tensor(name, 1);
    if (values.size(0) != size) refuse(name + " is of another size");
    return Eigen::Map<const Eigen::VectorXf>(values.data_ptr<float>(), size);
  }

  Eigen::MatrixXf matrix(const std::string& name, Eigen::Index columns) const {
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const at::Tensor values = tensor(name, 2);
    if (values.size(1) != columns) refuse(name + " is of another size");
    return Eigen::Map<const RowMajor>(values.data_ptr<float>(), values.size(0), columns);
  }
};

}  // namespace

DenseNetwork DenseNetwork::read(const SafeTensors& file, Eigen::Index inputs, Eigen::Index outputs,
                                const std::function<void(const std::string&)>& refuse) {
  const Reader reader{file, refuse};
  DenseNetwork network;
  network.mean_ = reader.vector("feature.mean", inputs);
  network.sd_ = reader.vector("feature.sd", inputs);
  if (!(network.sd_.array() > 0).all()) refuse("a feature does not vary in it");
  Eigen::Index width = inputs;
  for (const char* layer : {"layer1", "layer2", "layer3"}) {
    Eigen::MatrixXf weight = reader.matrix(std::string(layer) + ".weight", width);
    width = weight.rows();
    network.layers_.push_back({std::move(weight), reader.vector(std::string(layer) + ".bias", width)});
  }
  if (width != outputs) refuse("it has " + std::to_string(width) + " outputs");
  return network;
}

Eigen::VectorXd DenseNetwork::operator()(const Eigen::VectorXf& features) const {
  Eigen::VectorXf x = ((features - mean_).array() / sd_.array()).max(-kFarthestFeature).min(kFarthestFeature);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    x = layers_[i].weight * x + layers_[i].bias;
    if (i + 1 < layers_.size()) x = x.cwiseMax(0);
  }
  return x.cast<double>();
}

Eigen::VectorXd softmax(const Eigen::VectorXd& logits) {
  const Eigen::VectorXd weights = (logits.array() - logits.maxCoeff()).exp();
  return weights / weights.sum();
}

}  // namespace patina
