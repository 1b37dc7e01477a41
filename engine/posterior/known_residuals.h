#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "engine/posterior/emulator.h"

namespace patina {

/// Where a summary's residuals are known, as it grows: their products are made once each.
class KnownResiduals {
 public:
  /// @param places  of the coordinates that are emulated, a column each   @param residuals  there, likewise
  /// @param threads, enter_thread  as parallel_for() has them
  void add(const Eigen::MatrixXd& places, const Eigen::MatrixXf& residuals, int threads = 1,
           const std::function<void()>& enter_thread = {});

  Eigen::Index count() const { return all_.count(); }
  const EmulatorExamples& all() const { return all_; }

  /// Those that are not hopelessly far from the best, but at least so many: the others would only bend
  /// polynomials where they are wanted.
  EmulatorExamples worth_learning(Eigen::Index least) const;

 private:
  EmulatorExamples some(const std::vector<Eigen::Index>& which) const;

  EmulatorExamples all_;
  Eigen::MatrixXf residuals_;
};

}  // namespace patina
