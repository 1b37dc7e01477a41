#include "engine/chart/problem.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "engine/run/chain_start.h"
#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"

namespace patina {

std::unique_ptr<Kernel> ChartProblem::kernel(const ChartSetting& setting, const LogDensity& target) const {
  return make_kernel(setting.kernel, target, setting.alpha, setting.refresh, setting.discrete,
                     setting.path_length);
}

ChartProblem::Learnt ChartProblem::learn(const ChartSetting& setting, std::uint64_t,
                                         const std::function<void()>&) const {
  throw std::invalid_argument("nothing can be learnt of this target for '" + setting.name + "'");
}

std::optional<ChartProblem::Averaged> ChartProblem::average(const ChartSetting& setting,
                                                            const std::vector<ChainState>&, std::uint64_t,
                                                            const std::function<void()>&) const {
  throw std::invalid_argument("this target cannot be averaged for '" + setting.name + "'");
}

Emulation ChartProblem::emulate(const ChartSetting& setting, const std::vector<ChainState>&, const Metric&,
                                std::uint64_t, const std::function<void()>&) const {
  throw std::invalid_argument("this target cannot be emulated for '" + setting.name + "'");
}

Emulator ChartProblem::emulate_about(const ChartSetting& setting, const Eigen::MatrixXd&,
                                     const KnownResiduals&, const ChainState&, const Metric&, std::uint64_t,
                                     const std::function<void()>&) const {
  throw std::invalid_argument("this target cannot be emulated for '" + setting.name + "'");
}

std::unique_ptr<LogDensity> target_of(const ChartProblem& problem) {
  return std::move(problem.targets(default_setting()).back());
}

std::vector<double> fingerprint(const LogDensity& target) {
  constexpr int kPlaces = 4;
  constexpr std::uint64_t kSeed = 20;
  Rng rng(kSeed);
  std::vector<double> values;
  for (int i = 0; i < kPlaces; ++i)
    values.push_back(evaluate_finite(target, prior_draw(target, rng)).log_density);
  return values;
}

bool same_target(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kRounding = 1e-4;  // of sums over float32 renders, on however many threads
  return std::ranges::equal(a, b, [](double x, double y) {
    return x == y || std::abs(x - y) <= kRounding * std::max({1.0, std::abs(x), std::abs(y)});
  });
}

}  // namespace patina
