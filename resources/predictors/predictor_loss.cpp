#include "resources/predictors/predictor_loss.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/bmm.h>
#include <ATen/ops/cross_entropy_loss.h>
#include <ATen/ops/tril_indices.h>
#include <ATen/ops/zeros.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/io/random_access_file.h"
#include "engine/prediction/predictor.h"
#include "engine/summary/network.h"
#include "engine/summary/tensor_index.h"

namespace patina {

std::int64_t predictor_outputs(const ParameterTable& table) {
  const auto p = std::ssize(table.continuous);
  std::int64_t count = 2 * p + p * (p - 1) / 2;
  for (const DiscreteParameter& choice : table.discrete) count += std::ssize(choice.levels);
  return count;
}

at::Tensor predictor_loss(const ParameterTable& table, const at::Tensor& outputs,
                          const at::Tensor& coordinates, const at::Tensor& levels) {
  const std::int64_t n = outputs.size(0), p = coordinates.size(1), below = p * (p - 1) / 2;
  const at::Tensor log_diagonal = outputs.narrow(1, p, p).clamp(kLeastLogPrecision, kMostLogPrecision);
  const at::Tensor places = at::tril_indices(p, p, -1);
  const at::Tensor factor = at::zeros({n, p * p})
                                .index_copy(1, places[0] * p + places[1], outputs.narrow(1, 2 * p, below))
                                .view({n, p, p}) +
                            log_diagonal.exp().diag_embed();
  const at::Tensor error = (coordinates - outputs.narrow(1, 0, p)).unsqueeze(2);
  const at::Tensor whitened = at::bmm(factor.transpose(1, 2), error);
  at::Tensor loss = 0.5 * whitened.square().sum() / n - log_diagonal.sum() / n +
                    0.5 * static_cast<double>(p) * std::log(2 * std::numbers::pi);
  std::int64_t logit = 2 * p + below;
  for (std::size_t i = 0; i < table.discrete.size(); ++i) {
    const auto count = std::ssize(table.discrete[i].levels);
    loss = loss + at::cross_entropy_loss(outputs.narrow(1, logit, count),
                                         levels.select(1, static_cast<std::int64_t>(i)));
    logit += count;
  }
  return loss;
}

double prior_loss(const ParameterTable& table) {
  double loss = 0.5 * static_cast<double>(table.continuous.size()) * (1 + std::log(2 * std::numbers::pi));
  for (const DiscreteParameter& choice : table.discrete)
    loss += std::log(static_cast<double>(choice.levels.size()));
  return loss;
}

SafeTensors predictor_file(const ParameterTable& table, const DenseStudent& student) {
  SafeTensors file = student.to_file();
  using Json = nlohmann::ordered_json;
  Json parameters = Json::array(), choices = Json::array();
  for (const Parameter& parameter : table.continuous) {
    const TruncatedNormal& prior = parameter.prior;
    parameters.push_back({{"name", parameter.name},
                          {"prior", {prior.mean, prior.sd, prior.low, prior.high}},
                          {"camera_power", parameter.camera_power}});
  }
  for (const DiscreteParameter& choice : table.discrete)
    choices.push_back({{"name", choice.name}, {"levels", choice.levels.size()}});
  file.metadata["patina_predictor"] = Json{
      {"format", 1},
      {"material", table.material},
      {"network_sha256", RandomAccessFile(bundled_network(), kMaxNetworkBytes).sha256_hex()},
      {"parameters", parameters},
      {"choices", choices}}.dump();
  return file;
}

}  // namespace patina
