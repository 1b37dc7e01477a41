#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"

namespace patina {
namespace {

class Mixture final : public Kernel {
 public:
  Mixture(std::unique_ptr<Kernel> continuous, std::unique_ptr<Kernel> discrete, double alpha)
      : continuous_(std::move(continuous)), discrete_(std::move(discrete)), alpha_(alpha) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    // The choice looks at nothing but the generator: were alpha to depend on the state, it would enter the
    // ratio.
    const Kernel& chosen = rng.uniform() < alpha_ ? *continuous_ : *discrete_;
    return chosen.step(target, settings, state, rng);
  }

  double target_acceptance() const override { return continuous_->target_acceptance(); }

 private:
  std::unique_ptr<Kernel> continuous_, discrete_;
  double alpha_;
};

std::unique_ptr<Kernel> make_continuous(const std::string& name, double path_length) {
  if (name == "mh") return make_random_walk();
  if (name == "mala") return make_mala();
  if (name == "hmc") return make_hmc(path_length);
  if (name == "nuts") return make_nuts();
  throw std::invalid_argument("unknown kernel '" + name + "'");
}

std::unique_ptr<Kernel> make_discrete(const std::string& name) {
  if (name == "joint") return make_discrete_move();
  if (name == "single") return make_single_discrete_move();
  throw std::invalid_argument("unknown discrete proposal '" + name + "'");
}

void check_alpha(double alpha) {
  if (!(alpha > 0 && alpha <= 1)) throw std::invalid_argument("alpha must be in (0, 1]");
}

}  // namespace

std::unique_ptr<Kernel> make_mixture(std::unique_ptr<Kernel> continuous, std::unique_ptr<Kernel> discrete,
                                     double alpha) {
  check_alpha(alpha);
  return std::make_unique<Mixture>(std::move(continuous), std::move(discrete), alpha);
}

std::vector<std::string> kernel_names() { return {"mh", "mala", "hmc", "nuts"}; }

std::vector<std::string> discrete_names() { return {"joint", "single"}; }

std::unique_ptr<Kernel> make_kernel(const std::string& name, const LogDensity& target, double alpha,
                                    double refresh, const std::string& discrete, double path_length) {
  check_alpha(alpha);
  if (!(refresh >= 0 && refresh < 1)) throw std::invalid_argument("refresh must be in [0, 1)");
  std::unique_ptr<Kernel> continuous = make_continuous(name, path_length);
  const std::vector<bool> jagged = target.jagged();
  const auto jagged_count = std::ranges::count(jagged, true);
  if (jagged_count > 0 && refresh == 0) throw std::invalid_argument("jagged coordinates need refresh moves");
  if (jagged_count > 0) continuous = make_smooth_block(std::move(continuous));
  const bool nothing_smooth = jagged_count > 0 && jagged_count == target.dimension();
  if (refresh > 0)
    continuous = nothing_smooth ? make_refresh_move()
                                : make_mixture(std::move(continuous), make_refresh_move(), 1 - refresh);
  continuous = make_straightened(std::move(continuous));
  std::unique_ptr<Kernel> levels = make_discrete(discrete);
  if (target.discrete_levels().empty()) return continuous;
  if (target.dimension() == 0) return levels;
  return make_mixture(std::move(continuous), std::move(levels), alpha);
}

bool has_jagged(const LogDensity& target) { return std::ranges::count(target.jagged(), true) > 0; }

double usual_refresh(bool has_jagged) { return has_jagged ? 0.75 : 0.25; }

int usual_warmup(bool has_jagged) { return has_jagged ? 1500 : 500; }

}  // namespace patina
