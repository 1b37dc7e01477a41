#include "engine/sampling/optimizer.h"

#include <lbfgs.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "engine/sampling/finite_evaluation.h"

namespace patina {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kValueWindow = 5;  // iterations over which the value must improve

/// One climb: what liblbfgs calls back into. It minimises, so values and gradients change sign here. The best
/// point is kept here too, because a failed line search may end elsewhere.
class Climb {
 public:
  Climb(const LogDensity& target, const Position& start, const OptimizerSettings& settings)
      : target_(target), settings_(settings), trial_(start) {
    best_.position = start;
    best_.evaluation = {-kInfinity, Eigen::VectorXd::Zero(start.continuous.size())};
  }

  OptimizerResult run() {
    const auto n = static_cast<int>(trial_.continuous.size());
    if (n == 0) return only_point();
    const std::unique_ptr<double[], decltype(&lbfgs_free)> x(lbfgs_malloc(n), lbfgs_free);
    if (!x) throw std::bad_alloc();
    Eigen::VectorXd::Map(x.get(), n) = trial_.continuous;

    lbfgs_parameter_t parameters = lbfgs_parameters();
    const int code = lbfgs(n, x.get(), nullptr, evaluate, progress, this, &parameters);
    if (failure_) std::rethrow_exception(failure_);
    if (best_.stopped_because.empty()) best_.stopped_because = describe(code);
    return best_;
  }

 private:
  lbfgs_parameter_t lbfgs_parameters() const {
    lbfgs_parameter_t parameters;
    lbfgs_parameter_init(&parameters);
    parameters.m = 10;
    parameters.epsilon = settings_.gradient_tolerance;
    parameters.max_iterations = settings_.max_iterations;
    // Backtracking is the one search of the library that steps back from an infinite value.
    parameters.linesearch = LBFGS_LINESEARCH_BACKTRACKING_STRONG_WOLFE;
    parameters.max_linesearch = 20;
    return parameters;
  }

  OptimizerResult only_point() {
    best_.evaluation = evaluate_finite(target_, trial_);
    best_.evaluations = 1;
    best_.stopped_because = "there is nothing continuous to climb";
    return best_;
  }

  static double evaluate(void* self, const double* x, double* gradient, int n, double) {
    return static_cast<Climb*>(self)->minus_log_density(x, gradient, n);
  }

  /// An exception must not cross the C library: it is kept, and the search starved until it gives up.
  double minus_log_density(const double* x, double* gradient, int n) {
    Eigen::VectorXd::Map(gradient, n).setZero();
    if (failure_) return kInfinity;
    try {
      trial_.continuous = Eigen::VectorXd::Map(x, n);
      Evaluation evaluation = evaluate_finite(target_, trial_);
      ++best_.evaluations;
      Eigen::VectorXd::Map(gradient, n) = -evaluation.gradient;
      const double value = -evaluation.log_density;
      if (evaluation.log_density > best_.evaluation.log_density) {
        best_.position = trial_;
        best_.evaluation = std::move(evaluation);
      }
      return value;
    } catch (...) {
      failure_ = std::current_exception();
      return kInfinity;
    }
  }

  static int progress(void* self, const double*, const double*, double value, double, double, double, int,
                      int, int) {
    return static_cast<Climb*>(self)->should_stop(value);
  }

  bool should_stop(double value) {
    if (failure_) return true;
    if (settings_.stop_requested && settings_.stop_requested()) {
      best_.stopped_because = "a stop was requested";
      return true;
    }
    if (-value >= settings_.good_enough) {
      best_.stopped_because = "what was asked for was reached";
      return true;
    }
    if (++iterations_ == settings_.max_iterations / 2 && -value < settings_.hopeless) {
      best_.stopped_because = "half of the iterations led hardly anywhere";
      return true;
    }
    recent_values_.push_back(value);
    if (recent_values_.size() <= kValueWindow) return false;
    const double improvement = recent_values_.front() - value;
    recent_values_.pop_front();
    if (improvement >= settings_.value_tolerance * std::max(1.0, std::abs(value))) return false;
    best_.stopped_because = "the value no longer improves";
    return true;
  }

  std::string describe(int code) const {
    if (best_.evaluation.log_density == -kInfinity) return "the start has no density";
    if (code == LBFGS_SUCCESS || code == LBFGS_ALREADY_MINIMIZED) return "the gradient vanished";
    if (code == LBFGSERR_MAXIMUMITERATION) return "the limit of iterations was reached";
    return "the line search found no better point";
  }

  const LogDensity& target_;
  const OptimizerSettings& settings_;
  Position trial_;
  OptimizerResult best_;
  int iterations_ = 0;
  std::deque<double> recent_values_;
  std::exception_ptr failure_;
};

}  // namespace

OptimizerResult maximize(const LogDensity& target, const Position& start, const OptimizerSettings& settings) {
  return Climb(target, start, settings).run();
}

}  // namespace patina
