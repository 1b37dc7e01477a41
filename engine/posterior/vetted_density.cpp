#include "engine/posterior/vetted_density.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <utility>

#include "engine/posterior/posterior.h"
#include "engine/posterior/wider_errors.h"
#include "engine/sampling/archive.h"

namespace patina {

bool AveragedEmulator::is_of(Eigen::Index dimension, Eigen::Index informed) const {
  return emulator.is_of(informed) && std::isfinite(allowance) && covariance.rows() == dimension &&
         covariance.cols() == dimension && covariance.allFinite() &&
         covariance.isApprox(covariance.transpose()) && covariance.llt().info() == Eigen::Success;
}

void AveragedEmulator::serialise(Archive& archive) { archive(emulator, allowance, covariance); }

VettedDensity::VettedDensity(AveragedEmulator average, std::shared_ptr<const LogDensity> by_render,
                             std::vector<Eigen::Index> informed)
    : average_(std::move(average)),
      by_render_(std::move(by_render)),
      informed_(std::move(informed)),
      emulated_(average_.emulator, informed_, *by_render_) {}

Evaluation VettedDensity::vetted(const Position& position, Evaluation by_render) const {
  by_render.log_density += average_.allowance;
  if (!position.continuous.allFinite()) return by_render;
  Evaluation emulated = emulated_.evaluate(position);
  return by_render.log_density < emulated.log_density ? std::move(by_render) : std::move(emulated);
}

Evaluation VettedDensity::evaluate(const Position& position) const {
  return vetted(position, by_render_->evaluate(position));
}

Evaluation VettedDensity::value(const Position& position) const {
  Evaluation value = vetted(position, by_render_->value(position));
  value.gradient.resize(0);
  return value;
}

std::unique_ptr<VettedDensity> averaged(const Posterior& by_hand, const WiderErrors& wider,
                                        const AveragedEmulator& average) {
  auto by_render = std::make_shared<const Posterior>(by_hand.with(wider.of_the_photo()));
  return std::make_unique<VettedDensity>(average, std::move(by_render), by_hand.informed());
}

}  // namespace patina
