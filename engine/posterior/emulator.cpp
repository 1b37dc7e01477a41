#include "engine/posterior/emulator.h"

#include <Eigen/Cholesky>

#include "engine/sampling/archive.h"

namespace patina {
namespace {

// Of the monomials' sums of squares, which are about as large as the number of examples.
constexpr double kRidge = 0.01;

Eigen::MatrixXd side_by_side(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(b.rows(), a.cols() + b.cols());
  if (a.cols() > 0) both.leftCols(a.cols()) = a;
  both.rightCols(b.cols()) = b;
  return both;
}

/// W with W W^T the inverse of the columns' covariance, lower triangular.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& centred) {
  const Eigen::Index d = centred.rows();
  const Eigen::MatrixXd covariance = centred * centred.transpose() / static_cast<double>(centred.cols() - 1) +
                                     1e-12 * Eigen::MatrixXd::Identity(d, d);
  return covariance.llt().matrixL().solve(Eigen::MatrixXd::Identity(d, d));
}

}  // namespace

void EmulatorExamples::add(const EmulatorExamples& more) {
  places = side_by_side(places, more.places);
  residuals = side_by_side(residuals, more.residuals);
}

Emulator::Emulator(const EmulatorExamples& examples, const LogParameters& axes) : axes_(axes) {
  Eigen::MatrixXd x = examples.places;
  for (auto column : x.colwise()) column = axes_.values(column);
  centre_ = x.rowwise().mean();
  whitening_ = whitening_of(x.colwise() - centre_);
  const Eigen::Index n = examples.count(), k = monomials(dimension());
  Eigen::MatrixXd design(n, k);
  for (Eigen::Index i = 0; i < n; ++i) design.row(i) = features(whitening_ * (x.col(i) - centre_));
  Eigen::VectorXd ridge = Eigen::VectorXd::Constant(k, kRidge);
  ridge[0] = 0;
  const Eigen::MatrixXd normal = design.transpose() * design + Eigen::MatrixXd(ridge.asDiagonal());
  const Eigen::MatrixXd smoother = normal.ldlt().solve(design.transpose());  // C^T is residuals smoother^T
  const Eigen::MatrixXd products = examples.residuals.transpose() * examples.residuals;
  weights_ = smoother * products * smoother.transpose();
}

Eigen::Index Emulator::monomials(Eigen::Index dimension) {
  return QuadraticFeatures(dimension, /*products=*/true).size() + dimension;
}

Eigen::VectorXd Emulator::features(const Eigen::VectorXd& w) const {
  Eigen::VectorXd f(monomials(w.size()));
  f << quadratic().values(w), w.array().cube().matrix();
  return f;
}

Eigen::VectorXd Emulator::slope(const Eigen::VectorXd& w, const Eigen::VectorXd& weights) const {
  const Eigen::Index d = w.size();
  Eigen::VectorXd slope = weights.segment(1, d) + 2 * w.cwiseProduct(weights.segment(1 + d, d)) +
                          3 * w.cwiseAbs2().cwiseProduct(weights.tail(d));
  Eigen::Index k = 1 + 2 * d;
  for (Eigen::Index i = 0; i < d; ++i)
    for (Eigen::Index j = 0; j < i; ++j, ++k) {
      slope[i] += w[j] * weights[k];
      slope[j] += w[i] * weights[k];
    }
  return slope;
}

Evaluation Emulator::evaluate(const Position& position) const {
  const Eigen::VectorXd& u = position.continuous;
  const Eigen::VectorXd w = whitening_ * (axes_.values(u) - centre_), f = features(w), pull = weights_ * f;
  const Eigen::VectorXd by_axis = whitening_.transpose() * slope(w, pull);
  return {-u.squaredNorm() / 2 - f.dot(pull) / 2, -u - axes_.derivatives(u).cwiseProduct(by_axis)};
}

Emulator Emulator::softened(double power) const {
  Emulator soft = *this;
  soft.weights_ *= power;
  return soft;
}

bool Emulator::is_of(Eigen::Index dimension) const {
  const Eigen::Index k = monomials(dimension);
  return axes_.fits(dimension) && centre_.size() == dimension && whitening_.rows() == dimension &&
         whitening_.cols() == dimension && weights_.rows() == k && weights_.cols() == k &&
         centre_.allFinite() && whitening_.allFinite() && weights_.allFinite();
}

void Emulator::serialise(Archive& archive) { archive(axes_, centre_, whitening_, weights_); }

}  // namespace patina
