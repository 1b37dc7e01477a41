#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/posterior/emulator.h"
#include "engine/posterior/informed_density.h"
#include "engine/sampling/log_density.h"

namespace patina {

class Archive;
class Posterior;
struct WiderErrors;

/// What polynomials say of renders on average over irregularities, and how much further one render may be
/// off.
struct AveragedEmulator {
  Emulator emulator;           ///< of the informed coordinates
  double allowance = 0;        ///< nats; below zero a render decides more often than polynomials
  Eigen::MatrixXd covariance;  ///< of the average, of all coordinates, about: what chains may begin with

  /// Whether it can be of so many coordinates, and so many of them that are emulated.
  bool is_of(Eigen::Index dimension, Eigen::Index informed) const;
  void serialise(Archive& archive);
};

/// A posterior averaged over irregularities, which nobody knows of a photo: the mean of a summary is
/// polynomials' (a synthetic likelihood: Wood 2010; Price, Drovandi, Lee, Nott 2018), so that the luck of one
/// z, a wrinkle at each place, is no part of it; and a render with one z has a veto where polynomials promise
/// what is not there,
///   log p(u) = min(log p_emulated(u), log p_z(u) + allowance)
/// As it is nowhere above the emulated density, it can be drawn from by rejection (make_rejection): draws
/// hardly depend on each other, and there are no pits to stay in.
class VettedDensity final : public LogDensity {
 public:
  /// @param by_render  the posterior given one z   @param informed  its coordinates that are emulated
  VettedDensity(AveragedEmulator average, std::shared_ptr<const LogDensity> by_render,
                std::vector<Eigen::Index> informed);

  Eigen::Index dimension() const override { return by_render_->dimension(); }
  std::vector<int> discrete_levels() const override { return by_render_->discrete_levels(); }
  Evaluation evaluate(const Position& position) const override;
  Evaluation value(const Position& position) const override;

  VettedDensity(const VettedDensity&) = delete;  // a part of it refers to another
  VettedDensity& operator=(const VettedDensity&) = delete;

  const Emulator& emulator() const { return average_.emulator; }
  const std::vector<Eigen::Index>& informed() const { return informed_; }

 private:
  Evaluation vetted(const Position& position, Evaluation by_render) const;

  AveragedEmulator average_;
  std::shared_ptr<const LogDensity> by_render_;
  std::vector<Eigen::Index> informed_;
  InformedDensity emulated_;
};

/// What a run draws from that averages over irregularities: its renders are judged by the photo's errors
/// alone.
/// @param by_hand  the posterior by hand-set errors   @param wider  measured at a match of it
std::unique_ptr<VettedDensity> averaged(const Posterior& by_hand, const WiderErrors& wider,
                                        const AveragedEmulator& average);

}  // namespace patina
