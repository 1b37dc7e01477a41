#pragma once

#include <Eigen/Core>

#include <vector>

namespace patina {

/// A point of a mixed space: continuous coordinates without bounds, and levels of discrete ones.
struct Position {
  Eigen::VectorXd continuous;
  Eigen::VectorXi discrete;
};

/// Value and gradient (with respect to the continuous coordinates; zero along jagged ones; empty where nobody
/// asked for it, see LogDensity::value()) of a log density.
struct Evaluation {
  double log_density = 0;
  Eigen::VectorXd gradient;
};

/// The target of every kernel. Contract: continuous coordinates are unconstrained and the log density
/// includes the Jacobian of whatever map leads there; constants are dropped; outside the support, or where
/// anything is not finite, the value is -infinity and the gradient zero. It throws only when the run
/// cannot go on (out of memory, bad device). evaluate() is safe to call from several threads.
class LogDensity {
 public:
  virtual ~LogDensity() = default;

  virtual Eigen::Index dimension() const = 0;

  /// The number of levels of each discrete coordinate; empty if there are none.
  virtual std::vector<int> discrete_levels() const { return {}; }

  /// Which continuous coordinates are jagged; empty: none. Along these the log density has wrinkles far
  /// narrower than its width, so that its slope says where the next wrinkle is and nothing else: the steps
  /// that it allows would stop a chain. evaluate() gives zero there; gradient kernels hold these coordinates,
  /// and moves that need no gradient take them along.
  virtual std::vector<bool> jagged() const { return {}; }

  virtual Evaluation evaluate(const Position& position) const = 0;

  /// The value alone: the gradient may be left empty where it costs extra. Moves that need no gradient ask
  /// for this.
  virtual Evaluation value(const Position& position) const { return evaluate(position); }
};

}  // namespace patina
