#include "engine/posterior/emulator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/posterior/matrix_product.h"
#include "engine/posterior/symmetric_kernel.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

// Of the monomials' sums of squares, which are about as large as the number of examples.
constexpr double kRidge = 0.01;

constexpr double kStep = 0.7;  // prior sds, of the step between two sides

constexpr double kFollowed = 2;  // nats a coordinate above the best example

// Of so few coordinates there are examples enough for all products of three.
constexpr Eigen::Index kFew = 10;

/// Monomials of the third degree.
Eigen::Index cubes(Eigen::Index d) { return d > kFew ? d : d * (d + 1) * (d + 2) / 6; }

/// Calls work(i, j, k) for w_i w_j w_k, each of these monomials.
template <typename Work>
void for_cubes(Eigen::Index d, Work&& work) {
  for (Eigen::Index i = 0; i < d; ++i) {
    if (d > kFew) {
      work(i, i, i);
      continue;
    }
    for (Eigen::Index j = 0; j <= i; ++j)
      for (Eigen::Index k = 0; k <= j; ++k) work(i, j, k);
  }
}

/// Of the squares that are made least, 1 on average: what lies a nat a coordinate deeper than the best counts
/// a quarter. Examples reach further than the posterior, and polynomials cannot follow all of it.
Eigen::VectorXd importance_of(const EmulatorExamples& examples) {
  const Eigen::ArrayXd energies = examples.energies().array();
  const auto dimension = static_cast<double>(examples.places.rows());
  const Eigen::ArrayXd importance = (1 + (energies - energies.minCoeff()) / dimension).square().inverse();
  return importance / importance.mean();
}

/// W with W W^T the inverse of the columns' covariance, lower triangular.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& centred) {
  const Eigen::Index d = centred.rows();
  const Eigen::MatrixXd covariance = centred * centred.transpose() / static_cast<double>(centred.cols() - 1) +
                                     1e-12 * Eigen::MatrixXd::Identity(d, d);
  return covariance.llt().matrixL().solve(Eigen::MatrixXd::Identity(d, d));
}

}  // namespace

Eigen::VectorXd EmulatorExamples::energies() const {
  return (places.colwise().squaredNorm().transpose() + products.diagonal()) / 2;
}

Emulator::Emulator(const EmulatorExamples& examples, const LogParameters& axes,
                   std::optional<Eigen::Index> sides)
    : axes_(axes), sides_(sides) {
  Eigen::MatrixXd x = examples.places;
  for (auto column : x.colwise()) column = axes_.values(column);
  centre_ = x.rowwise().mean();
  whitening_ = whitening_of(x.colwise() - centre_);
  const Eigen::Index n = examples.count(), k = size();
  Eigen::MatrixXd design(n, k);
  for (Eigen::Index i = 0; i < n; ++i)
    design.row(i) = features(whitening_ * (x.col(i) - centre_), side(examples.places.col(i)));
  Eigen::VectorXd ridge = Eigen::VectorXd::Constant(k, kRidge);
  ridge[0] = 0;
  const Eigen::VectorXd importance = importance_of(examples);
  const Eigen::MatrixXd weighted = design.transpose() * importance.asDiagonal();
  const Eigen::MatrixXd normal = weighted * design + Eigen::MatrixXd(ridge.asDiagonal());
  const Eigen::MatrixXd smoother = normal.ldlt().solve(weighted);  // C^T is residuals smoother^T
  weights_ = product(smoother, examples.products) * smoother.transpose();
  tail_ = static_cast<double>(dimension());
  followed_ = examples.products.diagonal().minCoeff() / 2 + kFollowed * tail_;
}

Eigen::Index Emulator::monomials(Eigen::Index dimension) {
  return QuadraticFeatures(dimension, /*products=*/true).size() + cubes(dimension);
}

bool Emulator::is_cubic() const { return dimension() <= kFew; }

double Emulator::side(const Eigen::VectorXd& u) const { return sides_ ? std::tanh(u[*sides_] / kStep) : 0; }

Eigen::VectorXd Emulator::features(const Eigen::VectorXd& w, double side) const {
  Eigen::VectorXd f(size());
  const QuadraticFeatures squares = quadratic();
  f.head(squares.size()) = squares.values(w);
  double* cube = f.data() + squares.size();
  for_cubes(w.size(), [&](Eigen::Index i, Eigen::Index j, Eigen::Index k) { *cube++ = w[i] * w[j] * w[k]; });
  if (sides_) f.tail(1 + w.size()) << side, side * w;
  return f;
}

Eigen::VectorXd Emulator::slope(const Eigen::VectorXd& w, double side, const Eigen::VectorXd& weights) const {
  const Eigen::Index d = w.size();
  Eigen::VectorXd slope = weights.segment(1, d) + 2 * w.cwiseProduct(weights.segment(1 + d, d));
  if (sides_) slope += side * weights.tail(d);
  Eigen::Index k = 1 + 2 * d;
  for (Eigen::Index i = 0; i < d; ++i)
    for (Eigen::Index j = 0; j < i; ++j, ++k) {
      slope[i] += w[j] * weights[k];
      slope[j] += w[i] * weights[k];
    }
  for_cubes(d, [&](Eigen::Index a, Eigen::Index b, Eigen::Index c) {
    const double weight = weights[k++];
    slope[a] += weight * w[b] * w[c];
    slope[b] += weight * w[a] * w[c];
    slope[c] += weight * w[a] * w[b];
  });
  return slope;
}

Evaluation Emulator::evaluate(const Position& position) const {
  const Eigen::VectorXd& u = position.continuous;
  const double side = this->side(u);
  const Eigen::VectorXd w = whitening_ * (axes_.values(u) - centre_), f = features(w, side);
  Eigen::VectorXd pull(f.size());
  symmetric::multiply(weights_.data(), f.data(), pull.data(), f.size());
  Eigen::VectorXd by_u = axes_.derivatives(u).cwiseProduct(whitening_.transpose() * slope(w, side, pull));
  if (sides_)
    by_u[*sides_] += (1 - side * side) / kStep * (pull[f.size() - 1 - w.size()] + pull.tail(w.size()).dot(w));
  const double misfit = f.dot(pull) / 2, beyond = std::max(misfit - followed_, 0.0);
  const double flat = std::min(misfit, followed_) + tail_ * std::log1p(beyond / tail_);
  const double share = tail_ / (tail_ + beyond);
  return {-u.squaredNorm() / 2 - flat, -u - share * by_u};
}

Emulator Emulator::softened(double power) const {
  Emulator soft = *this;
  soft.weights_ *= power;
  soft.followed_ *= power;
  soft.tail_ *= power;
  return soft;
}

bool Emulator::is_of(Eigen::Index dimension) const {
  const Eigen::Index k = size();
  return axes_.fits(dimension) && (!sides_ || (*sides_ >= 0 && *sides_ < dimension)) &&
         centre_.size() == dimension && whitening_.rows() == dimension && whitening_.cols() == dimension &&
         weights_.rows() == k && weights_.cols() == k && centre_.allFinite() && whitening_.allFinite() &&
         weights_.allFinite() && std::isfinite(followed_) && tail_ > 0 && std::isfinite(tail_);
}

void Emulator::serialise(Archive& archive) {
  archive(axes_, sides_, centre_, whitening_, weights_, followed_, tail_);
}

}  // namespace patina
