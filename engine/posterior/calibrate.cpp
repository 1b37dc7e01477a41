#include "engine/posterior/calibrate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "engine/posterior/measure_photo_fit.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"

namespace patina {
namespace {

/// The scores of the pilot and those of the round before.
struct ScoresInUse {
  const Scores& first;
  std::optional<Scores> latest;

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& summaries) const {
    const Eigen::MatrixXd a = first(summaries);
    if (!latest) return a;
    const Eigen::MatrixXd b = (*latest)(summaries);
    Eigen::MatrixXd both(a.rows() + b.rows(), a.cols());
    both << a, b;
    return both;
  }
};

/// The normal approximation of the posterior that a likelihood makes, from a place to climb from.
void approximate(const Posterior& posterior, const Eigen::VectorXd& start, Calibration& of) {
  const Posterior target = posterior.with(std::make_shared<const SyntheticLikelihood>(of.likelihood));
  const auto levels = static_cast<Eigen::Index>(posterior.discrete_levels().size());
  of.mode = maximize(target, {start, Eigen::VectorXi::Zero(levels)}).position.continuous;
  of.covariance = laplace_covariance(target, {of.mode, Eigen::VectorXi::Zero(levels)});
}

/// Whether a round's photos were where its posterior is, and along no coordinate much further apart.
bool settled(const Region& region, const Eigen::VectorXd& mode, const Eigen::MatrixXd& covariance) {
  constexpr double kWidest = 1.5, kNarrowest = 0.04;  // variances; a region of the right width has 0.44
  const Eigen::ArrayXd shares = covariance.diagonal().array() / region.factor.rowwise().squaredNorm().array();
  return region.offset(mode).norm() < std::sqrt(static_cast<double>(mode.size())) &&
         shares.maxCoeff() < kWidest && shares.minCoeff() > kNarrowest;
}

/// Whether no more rounds would bring a photo among the simulated ones.
bool out_of_reach(const PhotoFit& fit) {
  // Photos that the material can make are at 1 to 2 even in the first round, which may be beside the
  // posterior.
  constexpr double kFurthest = 3;
  return fit.distance > kFurthest;
}

Calibration in_rounds(const Simulator& simulator, const Pilot& pilot, const CalibrationSettings& settings) {
  const Posterior& posterior = simulator.posterior;
  const auto informed = posterior.informed();
  const Eigen::VectorXd photo = pilot.compression()(posterior.photo_summary());
  ScoresInUse scores{pilot.scores(), {}};
  Region region = pilot.region(scores(photo));
  Calibration result;
  for (int round = 1;; ++round) {
    const int photos = round == 1 ? settings.first : settings.later;
    const SimulatedPhotos simulated = simulate(simulator, region, photos, static_cast<std::uint64_t>(round));
    result.photos += photos;
    const Eigen::MatrixXd summaries = pilot.compression()(simulated.summaries);
    result.likelihood = SyntheticLikelihood(region, simulated.offsets, scores(summaries), scores(photo));
    Eigen::VectorXd start = Eigen::VectorXd::Zero(posterior.dimension());
    start(informed) = region.centre;
    approximate(posterior, start, result);
    const Eigen::VectorXd mode = result.mode(informed);
    const Eigen::MatrixXd covariance = result.covariance(informed, informed);
    result.fit = measure_photo_fit(simulated.offsets, summaries, photo, region.offset(mode));
    const bool hopeless = simulator.discrepancy == 0 && out_of_reach(result.fit);
    if (hopeless || round >= settings.most_rounds || (round > 1 && settled(region, mode, covariance))) {
      result.likelihood = result.likelihood.widened(result.fit.widening);
      approximate(posterior, result.mode, result);
      return result;
    }
    scores.latest.emplace(simulated.offsets, summaries);
    region = region_around(mode, covariance, region);
  }
}

}  // namespace

Calibration calibrate(const Simulator& simulator, const Pilot& pilot, const CalibrationSettings& settings) {
  Calibration exact = in_rounds(simulator, pilot, settings);
  if (exact.fit.p > kRare) return exact;
  Simulator rough = simulator;
  rough.discrepancy = 1;
  Calibration result = in_rounds(rough, pilot.with_discrepancy(rough), settings);
  result.fit.discrepancy = rough.discrepancy;
  result.photos += exact.photos;
  return result;
}

}  // namespace patina
