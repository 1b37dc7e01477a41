#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Hmc final : public Kernel {
 public:
  Hmc(double path_length, int most_steps, double careful)
      : path_length_(path_length), most_steps_(most_steps), careful_(careful) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return with_gradient(target, state, [&] { return move(target, settings, state, rng); });
  }

  /// The optimum of an evaluation's worth as the dimension grows is 0.651 (Beskos et al. 2013), and flat up
  /// to 0.9 (Betancourt, Byrne, Girolami 2014): a little above costs little and spares places that are
  /// narrower than most. The careful trajectories, which are nearly always accepted, raise the mean.
  double target_acceptance() const override { return 0.7 * (1 - careful_) + 0.95 * careful_; }

 private:
  TransitionInfo move(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const {
    assert(settings.metric && settings.metric->dimension() == state.position.continuous.size());
    const double step = settings.step_size * draw_share(rng);
    const int steps = draw_steps(step, rng);
    PhasePoint point{state, rng.normals(state.position.continuous.size())};
    const double before = energy(point);
    // The span of the energy, rather than its rise, is the same for the trajectory and its reverse. So is
    // whether it is stopped here, and a stopped one may count as rejected.
    double lowest = before, highest = before;
    bool divergent = false;
    int taken = 0;
    for (; taken < steps && !divergent; ++taken) {
      leapfrog(target, *settings.metric, step, point);
      lowest = std::min(lowest, energy(point));
      highest = std::max(highest, energy(point));
      divergent = std::isfinite(before) && highest - lowest > kDivergentEnergy;
    }
    const double after = energy(point);
    TransitionInfo info = metropolis_step(MoveKind::continuous, divergent ? -kInfinity : before - after,
                                          kInfinity, std::move(point.state), state, rng);
    info.divergent |= divergent;
    info.evaluations = taken;
    info.energy = info.accepted ? after : before;
    return info;
  }

  /// Of the step that warm-up says (Neal 2011, section 5.4.2.2). Like the number of steps it looks at the
  /// generator alone.
  double draw_share(Rng& rng) const {
    constexpr double kSmallestShare = 0.1;
    if (careful_ == 0 || rng.uniform() >= careful_) return 1;
    return std::pow(kSmallestShare, rng.uniform());
  }

  /// Uniform from 1 to about twice the mean: whatever the periods of the target, none is met every time (Neal
  /// 2011, section 5.3.2.2; Mackenzie 1989). It looks at the generator alone, else it would enter the ratio.
  int draw_steps(double step_size, Rng& rng) const {
    const double most = std::round(2 * path_length_ / step_size) - 1;
    return 1 + rng.below(static_cast<int>(std::clamp<double>(most, 1, most_steps_)));
  }

  double path_length_;
  int most_steps_;
  double careful_;
};

}  // namespace

std::unique_ptr<Kernel> make_hmc(double path_length, int most_steps, double careful) {
  if (!(path_length > 0 && most_steps > 0 && careful >= 0 && careful < 1))
    throw std::invalid_argument("a path must have a length");
  return std::make_unique<Hmc>(path_length, most_steps, careful);
}

}  // namespace patina
