#include "engine/posterior/emulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/posterior/informed_density.h"
#include "engine/posterior/known_residuals.h"
#include "engine/posterior/recording_density.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "engine/sampling/tempering.h"

namespace patina {
namespace {

// Apart from the search's and the chains'; what is learnt again sees other places of textures and levels.
constexpr std::uint64_t kEmulatorStream = 0x656d'756c, kAgainStream = kEmulatorStream + 1;

constexpr int kMovesFar = 50, kMovesNear = 1;                  // of a proposal
constexpr double kProposing = 0.9, kProposingIfJagged = 0.75;  // share of the proposals
constexpr double kNear = 0.25;                                 // of these, where the target is jagged

constexpr double kPathLength = 1.5;
constexpr double kSoftness = 0.8;  // power of the likelihood: from tails that are too heavy a way leads back
constexpr double kAlpha = 0.9;     // continuous moves, where there are levels
constexpr double kWideBeta = 0.5;  // inverse temperature of what spreads further than the posterior

/// What an emulator takes the target for, a little softened, and the kernel that proposes by it.
class Proposals {
 public:
  Proposals(const Emulator& emulator, const std::vector<Eigen::Index>& informed, const LogDensity& target)
      : emulator_(emulator.softened(kSoftness)), density_(emulator_, informed, target) {}
  Proposals(const Proposals&) = delete;  // its density refers to it
  Proposals& operator=(const Proposals&) = delete;

  /// Not straightened: the map that warm-up fits is no good in tails, and where it bends them chains stayed
  /// for thousands of iterations (of 50 moves from leather_6's, a fifteenth led out, a fifth as soon
  /// without).
  std::unique_ptr<Kernel> kernel(double path_length, int moves) const {
    constexpr int kMostSteps = 24;
    constexpr double kCareful = 0.4;
    const double refresh = usual_refresh(/*has_jagged=*/false);
    auto kernel = make_mixture(make_hmc(path_length, kMostSteps, kCareful), make_refresh_move(), 1 - refresh);
    if (!density_.discrete_levels().empty())
      kernel = make_mixture(std::move(kernel), make_discrete_move(), kAlpha);
    return make_two_stage(std::move(kernel), density_, moves);
  }

 private:
  Emulator emulator_;
  InformedDensity density_;
};

/// Far proposals alone, or near ones as well: what the emulator does not know of a jagged target is about the
/// same a step away, so that chains walk on where far proposals are refused.
std::unique_ptr<Kernel> proposing(const Proposals& proposals, const LogDensity& target, double path_length) {
  auto far = proposals.kernel(path_length, kMovesFar);
  if (!has_jagged(target)) return far;
  return make_mixture(std::move(far), proposals.kernel(path_length, kMovesNear), 1 - kNear);
}

/// Moves of the target that need no gradient, along jagged coordinates as well.
/// @param walk  of the continuous coordinates   @param refresh  share of these moves that are refresh moves
std::unique_ptr<Kernel> without_gradient(const LogDensity& target, std::unique_ptr<Kernel> walk,
                                         double refresh) {
  walk = make_mixture(std::move(walk), make_refresh_move(), 1 - refresh);
  if (target.discrete_levels().empty()) return walk;
  return make_mixture(std::move(walk), make_discrete_move(), kAlpha);
}

std::unique_ptr<Kernel> walk_of(const LogDensity& target) {
  return without_gradient(target, make_random_walk(), usual_refresh(has_jagged(target)));
}

/// What leads on where the emulator knows little. Jagged targets have pits, as narrow as nowhere else, that
/// walks of all scales lead out of in half the time of trajectories by gradients (leather_6,
/// resources/charts).
std::unique_ptr<Kernel> way_out_of(const LogDensity& target) {
  if (!has_jagged(target)) return walk_of(target);
  return without_gradient(target, make_walk_of_all_scales(), usual_refresh(/*has_jagged=*/false));
}

class EmulatedKernel final : public Kernel {
 public:
  EmulatedKernel(const Emulator& emulator, const std::vector<Eigen::Index>& informed,
                 const LogDensity& target, double path_length)
      : proposals_(emulator, informed, target),
        kernel_(make_mixture(proposing(proposals_, target, path_length), way_out_of(target),
                             has_jagged(target) ? kProposingIfJagged : kProposing)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return kernel_->step(target, settings, state, rng);
  }
  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  Proposals proposals_;
  std::unique_ptr<Kernel> kernel_;
};

/// A chain of the posterior that comes along while the emulator learns.
struct Walker {
  ChainState state;
  Rng rng;
  Evaluated record = {};
  double taken = 0;  ///< of its last proposals, the sum of the probabilities
};

class Learner {
 public:
  Learner(const Posterior& posterior, const std::vector<ChainState>& starts, const Metric& laplace,
          const EmulateSettings& settings, std::uint64_t stream)
      : posterior_(posterior),
        settings_(settings),
        mode_(starts.front().position.continuous),
        metric_(std::make_shared<const Metric>(laplace)),
        informed_(posterior.informed()),
        informed_laplace_(laplace.covariance()(informed_, informed_)),
        observed_(posterior.in_errors(posterior.photo_summary())),
        first_(2 * Emulator::monomials(std::ssize(informed_))),
        most_(settings.most > 0 ? settings.most : std::max(kFewest, 3 * first_)),
        rng_(settings.seed, stream) {
    const std::vector<TruncatedNormal> all = posterior.free_priors();
    std::vector<TruncatedNormal> priors;
    for (const Eigen::Index i : informed_) priors.push_back(all[static_cast<std::size_t>(i)]);
    axes_ =
        LogParameters::about(priors, mode_(informed_), informed_laplace_.covariance().diagonal().cwiseSqrt());
    for (int k = 0; k < kEmulatorWalkers; ++k)
      walkers_.push_back({starts[static_cast<std::size_t>(k) % starts.size()], Rng(rng_(), k)});
  }

  Emulation learn() {
    evaluate(about_the_mode());
    fit();
    Emulation result;
    std::vector<double> taken;  // by round
    for (;;) {
      const Eigen::Index more = std::max<Eigen::Index>(kLeastRound, known_.count() / 8);
      if (known_.count() + more > most_) break;
      const int steps = static_cast<int>(2 * more / 3 / kEmulatorWalkers);
      evaluate(softened_draws(static_cast<int>(more) - steps * kEmulatorWalkers));
      taken.push_back(walk(steps));
      fit();
      const auto lately = std::span(taken).last((taken.size() + 1) / 2);  // a round is a few proposals
      result.taken = std::accumulate(lately.begin(), lately.end(), 0.0) / static_cast<double>(lately.size());
      if (taken.size() > 1 && std::ranges::min(std::span(taken).last(2)) >= settings_.good) break;
    }
    if (result.taken >= settings_.poor) result.emulator = std::move(emulator_);
    result.known = std::move(known_);
    return result;
  }

  Emulator learn_at(const Eigen::MatrixXd& places, const KnownResiduals& known) {
    known_ = known;
    evaluate(places.rightCols(std::min(places.cols(), most_)));
    fit();
    const Eigen::Index a_round = std::max(kLeastRound, most_ / 2 / kRoundsAgain);
    for (int i = 0; i < kRoundsAgain; ++i) {
      const Eigen::MatrixXd draws = softened_draws(static_cast<int>(a_round));
      evaluate(draws);
      const bool was_right = was_right_about(draws);
      fit();
      if (was_right) break;
    }
    return std::move(emulator_);
  }

 private:
  static constexpr Eigen::Index kLeastRound = 60, kFewest = 1200;  // evaluations
  static constexpr int kRoundsAgain = 4;

  /// At informed coordinates; those of places and levels are drawn from their prior for each.
  void evaluate(const Eigen::MatrixXd& places) {
    const std::uint64_t seed = rng_();
    std::vector<Evaluated> records(static_cast<std::size_t>(places.cols()));
    const auto work = [&](std::size_t i) {
      Rng rng(seed, i);
      Position position = prior_draw(posterior_, rng);
      position.continuous(informed_) = places.col(static_cast<Eigen::Index>(i));
      recording(records[i]).evaluate(position);
    };
    parallel_for(records.size(), settings_.threads, work, settings_.enter_thread);
    add(records);
  }

  RecordingDensity recording(Evaluated& record) const {
    return {posterior_, informed_, observed_, settings_.evaluated, record};
  }

  /// Whether it is as exact as proposals need it, at places that were evaluated last.
  bool was_right_about(const Eigen::MatrixXd& places) const {
    constexpr double kRight = 0.3;  // nats, the median deviation: an sd of 0.45
    const Eigen::VectorXd energies = known_.all().energies().tail(places.cols());
    std::vector<double> errors;
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      errors.push_back(energies[i] + emulator_.evaluate({places.col(i), {}}).log_density);
    const double middle = median(errors);
    for (double& error : errors) error = std::abs(error - middle);
    return median(std::move(errors)) < kRight;
  }

  static double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  void fit() { emulator_ = Emulator(known_.worth_learning(first_), axes_); }

  Eigen::MatrixXd about_the_mode() {
    constexpr double kSpread = 1.2;  // Laplace's sds
    Eigen::MatrixXd places(std::ssize(informed_), first_);
    for (auto place : places.colwise())
      place = mode_(informed_) + kSpread * informed_laplace_.colour(rng_.normals(place.size()));
    return places;
  }

  /// So many draws, hardly depending on each other, of the prior and the root of the emulated likelihood:
  /// were they of the emulator itself, it would never learn of tails that it thinks too little of.
  Eigen::MatrixXd softened_draws(int count) {
    constexpr int kChains = 4, kApart = 10;
    SampleSettings settings;
    settings.chains = kChains;
    settings.warmup = 300;
    settings.draws = kApart * ((count + kChains - 1) / kChains);
    settings.seed = rng_();
    settings.noise_repeats = 0;
    settings.threads = settings_.threads;
    const TemperedDensity wide(emulator_, kWideBeta);
    const auto kernel =
        make_kernel("hmc", wide, 1, usual_refresh(/*has_jagged=*/false), "joint", kPathLength);
    const Sample sample = patina::sample(
        wide, *kernel, settings,
        [&](Rng&) {
          return Position{mode_(informed_), {}};
        },
        informed_laplace_);
    metric_ = with_informed(pooled(sample));
    Eigen::MatrixXd draws(std::ssize(informed_), count);
    for (Eigen::Index i = 0; i < draws.rows(); ++i)
      for (Eigen::Index j = 0; j < count; ++j)
        draws(i, j) = sample.coordinates[static_cast<std::size_t>(i)]((j / kChains) * kApart, j % kChains);
    return draws;
  }

  /// Of all draws, which the inverse temperature has spread.
  static Eigen::MatrixXd pooled(const Sample& wide) {
    const Eigen::Index d = std::ssize(wide.coordinates);
    Eigen::MatrixXd all(wide.log_density.size(), d);
    for (Eigen::Index i = 0; i < d; ++i)
      all.col(i) = wide.coordinates[static_cast<std::size_t>(i)].reshaped();
    all.rowwise() -= all.colwise().mean().eval();
    return kWideBeta / static_cast<double>(all.rows()) * all.transpose() * all;
  }

  /// The walkers' metric with that covariance of the informed coordinates.
  std::shared_ptr<const Metric> with_informed(const Eigen::MatrixXd& covariance) const {
    Eigen::MatrixXd whole = metric_->covariance().diagonal().asDiagonal();
    whole(informed_, informed_) =
        covariance + 1e-6 * Eigen::MatrixXd::Identity(covariance.rows(), covariance.rows());
    return std::make_shared<const Metric>(whole);
  }

  /// Every third step of a walker is a proposal. @return the share of these that were taken
  double walk(int steps) {
    const Proposals proposals(emulator_, informed_, posterior_);
    const auto proposal = proposals.kernel(kPathLength, kMovesFar), walk = walk_of(posterior_);
    const KernelSettings settings{.metric = metric_};
    const auto work = [&](std::size_t k) {
      Walker& walker = walkers_[k];
      walker.record = {};
      walker.taken = 0;
      const RecordingDensity target = recording(walker.record);
      for (int i = 0; i < steps; ++i) {
        const bool proposes = i % 3 == 0;
        const TransitionInfo info =
            (proposes ? *proposal : *walk).step(target, settings, walker.state, walker.rng);
        if (proposes) walker.taken += info.second_stage;
      }
    };
    parallel_for(walkers_.size(), settings_.threads, work, settings_.enter_thread);
    double taken = 0;
    std::vector<Evaluated> records;
    for (Walker& walker : walkers_) {
      records.push_back(std::move(walker.record));
      taken += walker.taken;
    }
    add(records);
    return taken / (kEmulatorWalkers * ((steps + 2) / 3));
  }

  /// All at once: each time costs a pass over what is known.
  void add(const std::vector<Evaluated>& records) {
    Eigen::Index count = 0;
    for (const Evaluated& record : records) count += std::ssize(record.places);
    if (count == 0) return;
    Eigen::MatrixXd places(std::ssize(informed_), count);
    Eigen::MatrixXf residuals(observed_.size(), count);
    Eigen::Index at = 0;
    for (const Evaluated& record : records)
      for (std::size_t i = 0; i < record.places.size(); ++i, ++at) {
        places.col(at) = record.places[i];
        residuals.col(at) = record.residuals[i];
      }
    known_.add(places, residuals, settings_.threads, settings_.enter_thread);
  }

  const Posterior& posterior_;
  const EmulateSettings& settings_;
  Eigen::VectorXd mode_;
  std::shared_ptr<const Metric> metric_;  ///< of walkers: Laplace's, then of the emulator's draws
  std::vector<Eigen::Index> informed_;
  Metric informed_laplace_;
  Eigen::VectorXd observed_;
  Eigen::Index first_, most_;  ///< evaluations
  Rng rng_;
  LogParameters axes_;
  std::vector<Walker> walkers_;  ///< the first begins at the mode
  KnownResiduals known_;
  Emulator emulator_;
};

}  // namespace

std::unique_ptr<Kernel> make_emulated_kernel(const Emulator& emulator,
                                             const std::vector<Eigen::Index>& informed,
                                             const LogDensity& target, double path_length) {
  return std::make_unique<EmulatedKernel>(emulator, informed, target, path_length);
}

bool can_emulate(const Posterior& posterior) { return !posterior.informed().empty(); }

bool misses_one(const Emulator& emulator, const std::vector<Eigen::Index>& informed, const LogDensity& target,
                const ChainState& mode, const std::vector<ChainState>& places) {
  if (has_jagged(target)) return false;
  constexpr double kAsGood = 7;  // nats below the mode: a thousandth of its density
  constexpr double kOff = 4;     // nats, several times what an emulator in use is off by
  const auto error_at = [&](const ChainState& state) {
    const Eigen::VectorXd& u = state.position.continuous;
    const Eigen::VectorXd known = u(informed);
    const double of_others = (u.squaredNorm() - known.squaredNorm()) / 2;
    return state.evaluation.log_density + of_others - emulator.evaluate({known, {}}).log_density;
  };
  return std::ranges::any_of(places, [&](const ChainState& place) {
    return place.evaluation.log_density > mode.evaluation.log_density - kAsGood &&
           !(std::abs(error_at(place) - error_at(mode)) < kOff);
  });
}

Emulation emulate(const Posterior& posterior, const std::vector<ChainState>& starts, const Metric& laplace,
                  const EmulateSettings& settings) {
  return Learner(posterior, starts, laplace, settings, kEmulatorStream).learn();
}

Emulator emulate_about(const Posterior& posterior, const Eigen::MatrixXd& places, const KnownResiduals& known,
                       const ChainState& mode, const Metric& laplace, const EmulateSettings& settings) {
  return Learner(posterior, {mode}, laplace, settings, kAgainStream).learn_at(places, known);
}

}  // namespace patina
