#include "engine/prediction/predictor.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/random_access_file.h"
#include "engine/material/capture_priors.h"
#include "engine/summary/network.h"
#include "engine/summary/safetensors.h"
#include "engine/summary/tensor_index.h"

namespace patina {

/// Reads one file, naming it in every complaint.
class PredictorReader {
 public:
  PredictorReader(const std::filesystem::path& file, const ParameterTable& table)
      : file_(file), contents_(read_safetensors(file)), table_(table) {}

  Predictor read() {
    Predictor predictor;
    read_metadata();
    predictor.table_ = table_;
    predictor.network_ = DenseNetwork::read(contents_, predictor.features_.size(), outputs(),
                                            [this](const std::string& why) { refuse(why); });
    return predictor;
  }

 private:
  using Json = nlohmann::json;

  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("The predictor " + file_.string() + " cannot be used: " + why +
                    "; reinstall Patina, or train it again (resources/predictors).");
  }

  void read_metadata() {
    const auto entry = contents_.metadata.find("patina_predictor");
    if (entry == contents_.metadata.end()) refuse("it does not say that it is one");
    const Json json = Json::parse(entry->second, nullptr, false);
    try {
      if (json.at("format") != 1) refuse("it is of another version");
      if (json.at("material") != table_.material) refuse("it is another material's");
      if (json.at("network_sha256") != RandomAccessFile(bundled_network(), kMaxNetworkBytes).sha256_hex())
        refuse("it was trained with another bundled network");
      read_parameters(json.at("parameters"));
      read_choices(json.at("choices"));
    } catch (const Json::exception&) {
      refuse("its description lacks something");
    }
  }

  void read_parameters(const Json& parameters) {
    if (parameters.size() != table_.continuous.size()) refuse("the material has other parameters now");
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      Parameter& parameter = table_.continuous[i];
      if (parameters[i].at("name") != parameter.name) refuse("the material has other parameters now");
      const auto prior = parameters[i].at("prior").get<std::vector<double>>();
      if (prior.size() != 4) refuse("a prior is not [mean, sd, low, high]");
      parameter.prior = {prior[0], prior[1], prior[2], prior[3]};
      parameter.camera_power = parameters[i].at("camera_power");
      const bool possible = parameter.prior.sd > 0 && parameter.prior.low < parameter.prior.high;
      if (!possible || std::abs(parameter.camera_power) > 4) refuse("a prior is impossible");
    }
  }

  void read_choices(const Json& choices) const {
    if (choices.size() != table_.discrete.size()) refuse("the material has other choices now");
    for (std::size_t i = 0; i < choices.size(); ++i)
      if (choices[i].at("name") != table_.discrete[i].name ||
          choices[i].at("levels") != table_.discrete[i].levels.size())
        refuse("the material has other choices now");
  }

  Eigen::Index outputs() const {
    const auto p = std::ssize(table_.continuous);
    Eigen::Index outputs = 2 * p + p * (p - 1) / 2;
    for (const DiscreteParameter& choice : table_.discrete) outputs += std::ssize(choice.levels);
    return outputs;
  }

  const std::filesystem::path& file_;
  SafeTensors contents_;
  ParameterTable table_;
};

namespace {

/// L from the logarithms of its diagonal and its rows below it.
Eigen::MatrixXd triangle(const Eigen::VectorXd& outputs, Eigen::Index p) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index i = 0, below = 2 * p; i < p; ++i) {
    factor(i, i) = std::exp(std::clamp(outputs[p + i], kLeastLogPrecision, kMostLogPrecision));
    for (Eigen::Index j = 0; j < i; ++j) factor(i, j) = outputs[below++];
  }
  return factor;
}

}  // namespace

Predictor Predictor::load(const std::filesystem::path& file, const ParameterTable& table) {
  return PredictorReader(file, table).read();
}

Prediction Predictor::predict(const Image& photo, const Capture& capture) const {
  return predict(features_(photo, capture), capture);
}

Prediction Predictor::predict(const Eigen::VectorXf& features, const Capture& capture) const {
  const Eigen::VectorXd outputs = network_(features);
  const auto p = std::ssize(table_.continuous);
  Prediction prediction{table_under(table_, capture), outputs.head(p), triangle(outputs, p), {}};
  Eigen::Index logit = 2 * p + p * (p - 1) / 2;
  for (const DiscreteParameter& choice : table_.discrete) {
    prediction.level_probabilities.push_back(softmax(outputs.segment(logit, std::ssize(choice.levels))));
    logit += std::ssize(choice.levels);
  }
  return prediction;
}

std::filesystem::path bundled_predictor(const std::string& material) {
  return data_directory() / "predictors" / (material + ".safetensors");
}

}  // namespace patina
