#include "engine/posterior/calibrate.h"

#include <utility>

#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"

namespace patina {
namespace {

constexpr double kReach = 1.5;

}  // namespace

CalibratedPosterior calibrate(const Posterior& posterior, const Position& mode,
                              const Eigen::MatrixXd& covariance, const SimulationSettings& settings,
                              IrregularityPool& pool) {
  Position centre = mode;
  Eigen::MatrixXd spread = covariance;
  for (int round = 1;; ++round) {
    SimulationSettings of_round = settings;
    of_round.seed = settings.seed + static_cast<std::uint64_t>(round);
    Posterior calibrated = posterior.calibrated_around(centre, kReach * kReach * spread, of_round, pool);
    OptimizerResult climbed = maximize(calibrated, centre);
    centre = climbed.position;
    spread = laplace_covariance(calibrated, centre);
    if (round == settings.rounds)
      return {std::move(calibrated), std::move(centre), std::move(climbed.evaluation), std::move(spread)};
  }
}

}  // namespace patina
