#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/material/irregularities.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/simulate.h"
#include "engine/sampling/prior_draw.h"

namespace patina {

/// The log density of a posterior's informed coordinates by the mean summary of renders, with irregularities
/// that no run learns from.
class MeanOfRenders {
 public:
  /// @param posterior  outlives this
  MeanOfRenders(const Posterior& posterior, std::size_t irregularities)
      : posterior_(posterior),
        informed_(posterior.informed()),
        observed_(posterior.in_errors(posterior.photo_summary())) {
    for (std::size_t k = 0; k < irregularities; ++k)
      others_.push_back(posterior.with(std::make_shared<const Irregularities>(kSimulatedSeeds + kApart + k)));
    for (std::size_t k = 0; k < irregularities; ++k)
      levels_.push_back(levels_of(posterior, Irregularities(kSimulatedSeeds + kApart + k)));
  }

  struct Value {
    double log_density = 0;
    double by_chance = 0;       ///< half the difference of the halves of the irregularities
    Eigen::RowVectorXd of_one;  ///< the log likelihood by each render alone
  };
  Value at(const Position& position, Rng& rng) const {
    Eigen::MatrixXd summaries(observed_.size(), std::ssize(others_));
    for (std::size_t k = 0; k < others_.size(); ++k) {
      Position place = prior_draw(posterior_, rng);
      place.continuous(informed_) = position.continuous(informed_);
      place.discrete = levels_[k];
      summaries.col(static_cast<Eigen::Index>(k)) = others_[k].predicted(place);
    }
    const double prior = -position.continuous(informed_).squaredNorm() / 2;
    const Eigen::Index half = summaries.cols() / 2;
    return {prior + log_likelihood(summaries),
            (log_likelihood(summaries.leftCols(half)) - log_likelihood(summaries.rightCols(half))) / 2,
            -(summaries.colwise() - observed_).colwise().squaredNorm() / 2};
  }

 private:
  static constexpr std::uint64_t kApart = 1'000'000;  // from what runs learn from

  /// By the mean, less what the scatter of so few renders adds to its distance.
  double log_likelihood(const Eigen::MatrixXd& summaries) const {
    const Eigen::VectorXd mean = summaries.rowwise().mean();
    const auto n = static_cast<double>(summaries.cols());
    const double scatter = (summaries.colwise() - mean).squaredNorm() / (n - 1);
    return -((mean - observed_).squaredNorm() - scatter / n) / 2;
  }

  const Posterior& posterior_;
  std::vector<Eigen::Index> informed_;
  Eigen::VectorXd observed_;
  std::vector<Posterior> others_;
  std::vector<Eigen::VectorXi> levels_;
};

}  // namespace patina
