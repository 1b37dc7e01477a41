#include "engine/posterior/emulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "engine/sampling/tempering.h"

namespace patina {
namespace {

constexpr std::uint64_t kEmulatorStream = 0x656d'756c;  // apart from the search's and the chains'
constexpr double kSpread = 1.2;                         // of the first round, Laplace's sds
constexpr int kRound = 60;                              // evaluations of every further one
constexpr double kBeta = 0.5;                           // of these, inverse temperature

class Learner {
 public:
  Learner(const Posterior& posterior, const EmulateSettings& settings)
      : posterior_(posterior),
        settings_(settings),
        observed_(posterior.photo_summary().cwiseQuotient(posterior.hand_set_errors())) {}

  EmulatorExamples evaluate(const Eigen::MatrixXd& places) const {
    EmulatorExamples examples{places, Eigen::MatrixXd(observed_.size(), places.cols())};
    const auto work = [&](std::size_t i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Position position{places.col(column), Eigen::VectorXi()};
      examples.residuals.col(column) = posterior_.predicted(position) - observed_;
      if (settings_.evaluated) settings_.evaluated();
    };
    parallel_for(static_cast<std::size_t>(places.cols()), settings_.threads, work, settings_.enter_thread);
    return examples;
  }

 private:
  const Posterior& posterior_;
  const EmulateSettings& settings_;
  Eigen::VectorXd observed_;
};

Eigen::MatrixXd about(const Position& mode, const Metric& laplace, Eigen::Index count, Rng& rng) {
  Eigen::MatrixXd places(mode.continuous.size(), count);
  for (auto place : places.colwise())
    place = mode.continuous + kSpread * laplace.colour(rng.normals(mode.continuous.size()));
  return places;
}

constexpr int kMovesAProposal = 50;
constexpr double kProposing = 0.8;  // share of the proposals; the others are random walks
constexpr double kPathLength = 1.5;
constexpr double kSoftness = 0.8;  // power of the likelihood: from tails that are too heavy a way leads back

/// HMC, and refresh moves.
std::unique_ptr<Kernel> kernel_of(const std::string& name, const LogDensity& target, double path_length) {
  return make_kernel(name, target, 1, usual_refresh(/*has_jagged=*/false), "joint", path_length);
}

/// So many draws, hardly depending on each other, of the prior and the root of the emulated likelihood: were
/// they of the emulator itself, it would never learn of tails that it thinks too little of, and a chain that
/// comes there would be kept there by the posterior.
Eigen::MatrixXd draws_of(const Emulator& emulator, const Position& start, const Metric& metric, int count,
                         std::uint64_t seed) {
  constexpr int kChains = 4, kApart = 10;
  SampleSettings settings;
  settings.chains = kChains;
  settings.warmup = 300;
  settings.draws = kApart * count / kChains;
  settings.seed = seed;
  settings.noise_repeats = 0;
  const TemperedDensity wide(emulator, kBeta);
  const auto kernel = kernel_of("hmc", wide, kPathLength);
  const Sample sample = patina::sample(
      wide, *kernel, settings, [&](Rng&) { return start; }, metric);
  Eigen::MatrixXd draws(emulator.dimension(), count);
  for (Eigen::Index i = 0; i < draws.rows(); ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      draws(i, j) = sample.coordinates[static_cast<std::size_t>(i)]((j / kChains) * kApart, j % kChains);
  return draws;
}

/// Those that are not hopelessly far from the best, but at least so many: the others would only bend
/// polynomials where they are wanted.
EmulatorExamples worth_learning(const EmulatorExamples& examples, Eigen::Index least) {
  constexpr double kFar = 5;  // nats a coordinate
  const Eigen::VectorXd energies =
      (examples.places.colwise().squaredNorm() + examples.residuals.colwise().squaredNorm()) / 2;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(examples.count()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return energies[i]; });
  const double far = energies[order.front()] + kFar * static_cast<double>(examples.places.rows());
  while (std::ssize(order) > least && energies[order.back()] > far) order.pop_back();
  return {examples.places(Eigen::all, order), examples.residuals(Eigen::all, order)};
}

/// Standard deviation of what the emulator's log densities are off by, a constant apart.
double error_of(const Emulator& emulator, const EmulatorExamples& fresh) {
  Eigen::VectorXd errors(fresh.count());
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    const Position position{fresh.places.col(i), Eigen::VectorXi()};
    const double exact = -position.continuous.squaredNorm() / 2 - fresh.residuals.col(i).squaredNorm() / 2;
    errors[i] = exact - emulator.evaluate(position).log_density;
  }
  return std::sqrt((errors.array() - errors.mean()).square().mean());
}

class EmulatedKernel final : public Kernel {
 public:
  EmulatedKernel(const Emulator& emulator, const LogDensity& target, double path_length)
      : proposals_(emulator.softened(kSoftness)),
        kernel_(make_mixture(
            make_two_stage(kernel_of("hmc", proposals_, path_length), proposals_, kMovesAProposal),
            kernel_of("mh", target, path_length), kProposing)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return kernel_->step(target, settings, state, rng);
  }
  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  Emulator proposals_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace

std::unique_ptr<Kernel> make_emulated_kernel(const Emulator& emulator, const LogDensity& target,
                                             double path_length) {
  return std::make_unique<EmulatedKernel>(emulator, target, path_length);
}

bool can_emulate(const Posterior& posterior) {
  return posterior.discrete_levels().empty() && !has_jagged(posterior);
}

bool misses_one(const Emulator& emulator, const ChainState& mode, const std::vector<ChainState>& places) {
  constexpr double kAsGood = 7;  // nats below the mode: a thousandth of its density
  constexpr double kOff = 4;     // nats, several times what an emulator in use is off by
  const auto error_at = [&](const ChainState& state) {
    return state.evaluation.log_density - emulator.evaluate(state.position).log_density;
  };
  return std::ranges::any_of(places, [&](const ChainState& place) {
    return place.evaluation.log_density > mode.evaluation.log_density - kAsGood &&
           !(std::abs(error_at(place) - error_at(mode)) < kOff);
  });
}

Emulation emulate(const Posterior& posterior, const Position& mode, const Metric& laplace,
                  const EmulateSettings& settings) {
  const Learner learner(posterior, settings);
  Rng rng(settings.seed, kEmulatorStream);
  const Eigen::Index first = 2 * Emulator::monomials(mode.continuous.size());
  EmulatorExamples examples = learner.evaluate(about(mode, laplace, first, rng));
  Emulation result;
  const LogParameters axes(posterior.free_priors());
  result.emulator = Emulator(examples, axes);
  for (double before = INFINITY; examples.count() + kRound <= settings.most; before = result.error) {
    const EmulatorExamples fresh = learner.evaluate(draws_of(*result.emulator, mode, laplace, kRound, rng()));
    result.error = error_of(*result.emulator, fresh);
    examples.add(fresh);
    result.emulator = Emulator(worth_learning(examples, first), axes);
    if (std::max(before, result.error) <= settings.good) break;  // once may be luck
  }
  result.evaluations = static_cast<int>(examples.count());
  if (!(result.error <= settings.poor)) result.emulator.reset();
  return result;
}

}  // namespace patina
