#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

constexpr double kDivergentRise = 1000;  // of the energy, as in Stan
constexpr int kMostSteps = 32;           // a step size that needs more is cheaper as a short path

class Hmc final : public Kernel {
 public:
  explicit Hmc(double path_length) : path_length_(path_length) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    PhasePoint point{state, rng.normals(state.position.continuous.size())};
    const double before = point.energy();
    // Jitter: a path of one length may come back to where it began, whatever the momentum (Neal 2011,
    // section 5.3.2).
    const double path = path_length_ * (0.5 + rng.uniform());
    const int steps = std::clamp(static_cast<int>(std::lround(path / settings.step_size)), 1, kMostSteps);
    int evaluations = 0;
    while (evaluations < steps && point.energy() - before <= kDivergentRise) {
      leapfrog(target, *settings.metric, settings.step_size, point);
      ++evaluations;
    }
    // A path that broke off has left the reach of any acceptance.
    const double rise = point.energy() - before;
    TransitionInfo info =
        metropolis_step(MoveKind::continuous, -rise, kNeverByDensity, std::move(point.state), state, rng);
    info.divergent = !(rise <= kDivergentRise);
    info.evaluations = evaluations;
    return info;
  }

  /// Beskos et al. 2013 find 0.651 in the limit of many dimensions.
  double target_acceptance() const override { return 0.651; }

 private:
  static constexpr double kNeverByDensity = std::numeric_limits<double>::infinity();

  double path_length_;
};

}  // namespace

std::unique_ptr<Kernel> make_hmc(double path_length) { return std::make_unique<Hmc>(path_length); }

}  // namespace patina
