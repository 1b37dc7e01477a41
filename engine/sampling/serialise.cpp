#include "engine/sampling/serialise.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace patina {
namespace {

/// What a Straightening is made of.
struct MapParts {
  Eigen::Index lead = 0;
  Eigen::VectorXd knots;
  Straightening::Coefficients coefficients;
};

bool can_be_a_map(const MapParts& parts) {
  const auto& [lead, knots, coefficients] = parts;
  const Eigen::MatrixXd& middle = coefficients.middle;
  const bool shapes = knots.size() >= 3 && middle.rows() == knots.size() && lead >= 0 &&
                      lead < middle.cols() && coefficients.log_width.rows() == middle.rows() &&
                      coefficients.log_width.cols() == middle.cols();
  return shapes && knots.allFinite() && middle.allFinite() && coefficients.log_width.allFinite() &&
         std::ranges::is_sorted(knots, std::less_equal<>()) && middle.col(lead).isZero(0) &&
         coefficients.log_width.col(lead).isZero(0);
}

}  // namespace

void serialise(Archive& archive, Position& position) { archive(position.continuous, position.discrete); }

void serialise(Archive& archive, Evaluation& evaluation) {
  archive(evaluation.log_density, evaluation.gradient);
}

void serialise(Archive& archive, ChainState& state) { archive(state.position, state.evaluation); }

void serialise(Archive& archive, KernelSettings& settings) {
  archive(settings.step_size, settings.metric, settings.straightening);
}

void serialise(Archive& archive, TemperedState& state) {
  archive(state.rungs, state.traveller, state.from_prior, state.rounds, state.round_trips);
}

void serialise(Archive& archive, LadderSettings& settings) { archive(settings.betas, settings.rungs); }

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

void serialise(Archive& archive, std::shared_ptr<const Straightening>& map) {
  MapParts parts;
  if (map) parts = {map->lead(), map->basis().knots(), map->coefficients()};
  archive(parts.lead, parts.knots, parts.coefficients.middle, parts.coefficients.log_width);
  if (!archive.reading()) return;
  map.reset();
  if (parts.knots.size() == 0) return;
  if (!can_be_a_map(parts)) throw ArchiveError("it holds a map of a ridge that cannot be one");
  map = std::make_shared<const Straightening>(parts.lead, NaturalSplineBasis(parts.knots),
                                              std::move(parts.coefficients));
}

}  // namespace patina
