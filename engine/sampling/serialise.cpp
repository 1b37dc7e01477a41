#include "engine/sampling/serialise.h"

namespace patina {

void serialise(Archive& archive, Position& position) { archive(position.continuous, position.discrete); }

void serialise(Archive& archive, Evaluation& evaluation) {
  archive(evaluation.log_density, evaluation.gradient);
}

void serialise(Archive& archive, ChainState& state) { archive(state.position, state.evaluation); }

void serialise(Archive& archive, KernelSettings& settings) { archive(settings.step_size, settings.metric); }

void serialise(Archive& archive, std::shared_ptr<const Metric>& metric) {
  Eigen::MatrixXd covariance;
  if (metric) covariance = metric->covariance();
  archive(covariance);
  if (!archive.reading()) return;
  if (covariance.size() == 0) {
    metric.reset();
    return;
  }
  try {
    metric = std::make_shared<const Metric>(covariance);
  } catch (const std::invalid_argument& error) {
    throw ArchiveError(error.what());
  }
}

}  // namespace patina
