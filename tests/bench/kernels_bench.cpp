// What a kernel is worth: effective draws (the smaller of bulk and tail ESS) of the worst coordinate per
// thousand evaluations, after the default warm-up of four chains from around the mode, Laplace's metric
// first, as in a run; the median of five seeds, and their range. Evaluations are what costs in Patina, so the
// clock plays no part.
//   bench-kernels [WORD]    only targets whose names hold the word: "truncated", "d = 23"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/sample.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

Eigen::MatrixXd autoregressive(Eigen::Index d, double correlation) {
  Eigen::MatrixXd matrix(d, d);
  for (Eigen::Index i = 0; i < d; ++i)
    for (Eigen::Index j = 0; j < d; ++j) matrix(i, j) = std::pow(correlation, std::abs(i - j));
  return matrix;
}

/// A correlated Gaussian truncated to the unit box, through the logit of each coordinate: means in the box,
/// at its border and outside it, standard deviations 0.2, correlation 0.7 between neighbours.
FunctionDensity truncated_gaussian(Eigen::Index d) {
  const Eigen::MatrixXd precision = (0.04 * autoregressive(d, 0.7)).inverse();
  Eigen::VectorXd mean(d);
  for (Eigen::Index i = 0; i < d; ++i) mean[i] = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1 : 1.1;
  return {d, [=](const Position& p) {
            const Eigen::ArrayXd t = 1 / (1 + (-p.continuous.array()).exp());
            const Eigen::VectorXd offset = t.matrix() - mean, pull = -precision * offset;
            const Eigen::ArrayXd slope = t * (1 - t);
            return Evaluation{0.5 * offset.dot(pull) + slope.log().sum(),
                              (slope * pull.array() + 1 - 2 * t).matrix()};
          }};
}

/// A prior N(0, I) in 13 dimensions, of which the photo determines eleven moderately and of two a curve
/// alone: x0 + x1 + 0.3 (x0^2 - 1) to 0.25. As a bump's scale and height, they correlate by -0.94, along a
/// bent ridge.
FunctionDensity bent_ridge() {
  constexpr double kError = 0.25;
  const Eigen::MatrixXd precision = (0.09 * autoregressive(11, 0.5)).inverse();
  return {
      13, [=](const Position& p) {
        const Eigen::VectorXd& x = p.continuous;
        const double misfit = (x[0] + x[1] + 0.3 * (x[0] * x[0] - 1)) / kError;
        const Eigen::VectorXd pull = -precision * x.tail(11);
        Evaluation result{-0.5 * x.squaredNorm() + 0.5 * x.tail(11).dot(pull) - 0.5 * misfit * misfit, -x};
        result.gradient.tail(11) += pull;
        result.gradient[0] -= misfit / kError * (1 + 0.6 * x[0]);
        result.gradient[1] -= misfit / kError;
        return result;
      }};
}

struct Worth {
  double per_thousand, acceptance, evaluations_a_draw, rhat;
};

Worth worth(const LogDensity& target, const Kernel& kernel, const SampleSettings& plan) {
  const Eigen::Index d = target.dimension();
  const Position mode = maximize(target, {Eigen::VectorXd::Zero(d), {}}).position;
  const Metric laplace(laplace_covariance(target, mode));
  const auto start = [&](Rng& rng) {
    return Position{mode.continuous + std::sqrt(2) * laplace.colour(rng.normals(d)), {}};
  };
  const Sample drawn = sample(target, kernel, plan, start, laplace);
  double least = 1e300, rhat = 0;
  for (const Eigen::MatrixXd& x : drawn.coordinates) {
    least = std::min({least, bulk_ess(x), tail_ess(x)});
    rhat = std::max(rhat, split_rhat(x));
  }
  return {1000 * least / drawn.evaluations, drawn.acceptance.front(),
          double(drawn.evaluations) / (plan.chains * plan.draws), rhat};
}

void compare(const std::string& name, const LogDensity& target, const std::string& label,
             const Kernel& kernel, double refresh, int draws) {
  std::vector<Worth> seeds;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    seeds.push_back(
        worth(target, kernel, {.draws = draws, .seed = seed, .metric_worth = 10.0 * target.dimension()}));
  std::ranges::sort(seeds, {}, &Worth::per_thousand);
  const Worth& middle = seeds[2];
  std::printf("%-18s %-8s %7.1f %8.2f (%6.2f ... %6.2f) %10.2f %11.2f %7.3f\n", name.c_str(), label.c_str(),
              refresh, middle.per_thousand, seeds.front().per_thousand, seeds.back().per_thousand,
              middle.acceptance, middle.evaluations_a_draw, middle.rhat);
}

void compare_named(const std::string& name, const LogDensity& target, double refresh,
                   const std::string& word) {
  if (name.find(word) == std::string::npos) return;
  for (const std::string& kernel : kernel_names())
    compare(name, target, kernel, *make_kernel(kernel, target, 1, refresh), refresh,
            kernel == "nuts" ? 3000 : 10000);
}

void compare_paths(const std::string& name, const LogDensity& target, double refresh,
                   const std::string& word) {
  if (name.find(word) == std::string::npos) return;
  for (const double path : {0.6, 1.0, 1.5, 2.5, 4.0}) {
    std::unique_ptr<Kernel> kernel = make_hmc(path);
    if (refresh > 0) kernel = make_mixture(std::move(kernel), make_refresh_move(), 1 - refresh);
    compare(name, target, "hmc " + std::to_string(path).substr(0, 3), *kernel, refresh, 8000);
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  using namespace patina;
  const std::string word = argc > 1 ? argv[1] : "";
  std::printf("%-18s %-8s %7s %8s %19s %10s %11s %7s\n", "target", "kernel", "refresh", "ESS/1000",
              "of five seeds", "acceptance", "evals/draw", "R-hat");
  for (const int d : {8, 16, 23}) {
    const std::string n = std::to_string(d);
    compare_named("gaussian, d = " + n, GaussianTarget(Eigen::VectorXd::Zero(d), autoregressive(d, 0.9)), 0,
                  word);
    compare_named("truncated, d = " + n, truncated_gaussian(d), 0, word);
  }
  for (const double refresh : {0.0, 0.1, 0.3}) {
    compare_named("bent ridge, d = 13", bent_ridge(), refresh, word);
    compare_paths("bent ridge, d = 13", bent_ridge(), refresh, word);
  }
}
