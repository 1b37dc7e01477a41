#pragma once

#include <Eigen/Core>

#include <optional>

#include "engine/posterior/log_parameters.h"
#include "engine/posterior/quadratic_features.h"
#include "engine/sampling/log_density.h"

namespace patina {

class Archive;

/// Places where a posterior's summary is known: what an emulator learns from.
struct EmulatorExamples {
  Eigen::MatrixXd places;  ///< of the coordinates that are emulated, a column each
  /// R^T R, the columns of R the residuals there: Posterior::predicted() minus the photo's. All that
  /// polynomials for squared residuals take, however long a summary is.
  Eigen::MatrixXd products;

  Eigen::Index count() const { return places.cols(); }
  Eigen::VectorXd energies() const;  ///< minus the log densities
};

/// A posterior whose renders are emulated: each entry of the summary is a polynomial of the coordinates, so
/// that value and gradient take microseconds (Conrad, Marzouk, Pillai, Smith 2016, "Accelerating
/// asymptotically exact MCMC for computationally intensive models via local approximations", whose model is
/// refined where it is used, too). With w the parameters' logarithms, centred and whitened over the examples,
/// and f(w) the monomials 1, w_i, w_i w_j and w_i^3, of at most ten coordinates all w_i w_j w_k,
///   log p(u) = -|u|^2 / 2 - 1/2 |C^T f(w)|^2
/// of which only C C^T is kept. Along a coordinate on both sides of whose middle the posterior has basins, f
/// has s and s w_i, too, with s = tanh(u_j / 0.7) a step from one side to the other: what holds of one need
/// not of the other (of wood_3's renders whose rings open upwards, polynomials without were off by half as
/// many nats again). Never above zero, so that no far place looks better than it may be. Where the
/// misfit is two nats a coordinate above the best example's, polynomials know little, and its rise E counts
/// for d log(1 + E / d) only: where they think a hundred nats too little of a place, chains that are there
/// are not held there by it. Draws of it are proposals (make_two_stage), nothing more.
class Emulator final : public LogDensity {
 public:
  Emulator() = default;  ///< to be read from an archive

  /// Least squares with a little ridge, in which examples that are good matches count more.
  /// @param examples  more than the monomials are, spread over all directions
  /// @param axes      of all coordinates that are emulated, or none
  /// @param sides     the coordinate that has such sides
  explicit Emulator(const EmulatorExamples& examples, const LogParameters& axes = {},
                    std::optional<Eigen::Index> sides = {});

  static Eigen::Index monomials(Eigen::Index dimension);

  Eigen::Index dimension() const override { return centre_.size(); }
  std::optional<Eigen::Index> sides() const { return sides_; }
  bool is_cubic() const;  ///< whether it has all products of three
  Evaluation evaluate(const Position& position) const override;

  /// With the likelihood to that power: below one its tails are heavier.
  Emulator softened(double power) const;

  /// Whether it can be of so many coordinates: sizes, numbers that are finite.
  bool is_of(Eigen::Index dimension) const;
  void serialise(Archive& archive);

 private:
  QuadraticFeatures quadratic() const { return {dimension(), /*products=*/true}; }
  Eigen::Index size() const { return monomials(dimension()) + (sides_ ? 1 + dimension() : 0); }  ///< of f
  double side(const Eigen::VectorXd& u) const;
  Eigen::VectorXd features(const Eigen::VectorXd& w, double side) const;
  /// The derivative of weights . f by w.
  Eigen::VectorXd slope(const Eigen::VectorXd& w, double side, const Eigen::VectorXd& weights) const;

  LogParameters axes_;
  std::optional<Eigen::Index> sides_;
  Eigen::VectorXd centre_;
  Eigen::MatrixXd whitening_;  ///< w = whitening (x - centre)
  Eigen::MatrixXd weights_;    ///< C C^T
  double followed_ = 0;        ///< nats of misfit up to which it is what the polynomials say
  double tail_ = 1;            ///< nats beyond, after which its rise counts by logarithms
};

}  // namespace patina
