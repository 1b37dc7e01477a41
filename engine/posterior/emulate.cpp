#include "engine/posterior/emulate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/known_residuals.h"
#include "engine/posterior/recording_density.h"
#include "engine/posterior/simulate.h"
#include "engine/sampling/best_first.h"
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

constexpr std::uint64_t kPoolSeeds = 100'000'000;  // of irregularities, where each evaluation has new ones

constexpr double kPathLength = 1.5;
constexpr double kWideBeta = 0.5;  // inverse temperature of what spreads further than the posterior

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
    sides_ = two_sided(starts);
    for (int k = 0; k < kEmulatorWalkers; ++k)
      walkers_.push_back({starts[static_cast<std::size_t>(k) % starts.size()], Rng(rng_(), k)});
  }

  Emulation learn() {
    evaluate(about_the_basins());
    fit();
    Emulation result;
    std::vector<double> taken;  // by round
    for (;;) {
      const Eigen::Index more = std::max<Eigen::Index>(kLeastRound, known_.count() / 8);
      if (known_.count() + more > most_) break;
      const int steps = static_cast<int>(2 * more / 3 / kEmulatorWalkers);
      evaluate(softened_draws(static_cast<int>(more) - steps * kEmulatorWalkers, kWideBeta));
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

  std::optional<AveragedEmulator> learn_average() {
    constexpr Eigen::Index kFewestOfAverage = 3200;
    constexpr int kChecked = 128;
    const Eigen::Index most = settings_.most > 0 ? most_ : std::max(kFewestOfAverage, most_);
    evaluate(about_the_basins());
    evaluate(about_the_starts());
    fit();
    for (;;) {
      const Eigen::Index more = std::max<Eigen::Index>(kLeastRound, known_.count() / 4);
      if (known_.count() + more + kChecked > most) break;
      const double beta = 2 * known_.count() < most ? kWideBeta : 1;
      if (share_kept(learn_from_draws(more, beta)) >= settings_.good) break;
    }
    const Eigen::MatrixXd draws = softened_draws(kChecked, 1);  // metric_ is theirs then
    evaluate(draws);
    const std::vector<double> deeper = deeper_than_promised(draws);
    const double allowed = allowance(deeper, luck_at_the_mode());
    if (share_taken(deeper, allowed) < settings_.poor) return {};
    return AveragedEmulator{std::move(emulator_), allowed, metric_->covariance()};
  }

  Emulator learn_at(const Eigen::MatrixXd& places, const KnownResiduals& known) {
    known_ = known;
    evaluate(places.rightCols(std::min(places.cols(), most_)));
    fit();
    for (int i = 0; i < kRoundsAgain; ++i)
      if (is_right(learn_from_draws(std::max(kLeastRound, most_ / 2 / kRoundsAgain), kWideBeta))) break;
    return std::move(emulator_);
  }

 private:
  static constexpr Eigen::Index kLeastRound = 60, kFewest = 1200;  // evaluations
  static constexpr int kRoundsAgain = 4;

  /// @return deeper_than_promised() by what it was learnt from before
  std::vector<double> learn_from_draws(Eigen::Index count, double beta) {
    const Eigen::MatrixXd draws = softened_draws(static_cast<int>(count), beta);
    evaluate(draws);
    std::vector<double> deeper = deeper_than_promised(draws);
    fit();
    return deeper;
  }

  /// At informed coordinates; those of places and levels are drawn from their prior for each.
  void evaluate(const Eigen::MatrixXd& places) {
    const std::uint64_t seed = rng_();
    std::vector<Evaluated> records(static_cast<std::size_t>(places.cols()));
    const auto work = [&](std::size_t i) {
      Rng rng(seed, i);
      Position position = prior_draw(posterior_, rng);
      position.continuous(informed_) = places.col(static_cast<Eigen::Index>(i));
      if (settings_.others)
        evaluate_with((*settings_.others)[seed % kPoolSeeds + i], std::move(position), records[i]);
      else
        recording(posterior_, records[i]).evaluate(position);
    };
    parallel_for(records.size(), settings_.threads, work, settings_.enter_thread);
    add(records);
  }

  /// With other irregularities, at the levels that they are shown at.
  void evaluate_with(std::shared_ptr<const Irregularities> z, Position position, Evaluated& record) const {
    position.discrete = levels_of(posterior_, *z);
    recording(posterior_.with(std::move(z)), record).evaluate(position);
  }

  RecordingDensity recording(const Posterior& posterior, Evaluated& record) const {
    return {posterior, informed_, observed_, settings_.evaluated, record};
  }

  /// Nats, at places that were evaluated last.
  std::vector<double> deeper_than_promised(const Eigen::MatrixXd& places) const {
    const Eigen::VectorXd energies = known_.all().energies().tail(places.cols());
    std::vector<double> deeper;
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      deeper.push_back(energies[i] + emulator_.evaluate({places.col(i), {}}).log_density);
    return deeper;
  }

  /// Whether it is as exact as proposals need it.
  static bool is_right(std::vector<double> deeper) {
    constexpr double kRight = 0.3;  // nats, the median deviation: an sd of 0.45
    const double middle = quantile(deeper, 0.5);
    for (double& error : deeper) error = std::abs(error - middle);
    return quantile(std::move(deeper), 0.5) < kRight;
  }

  /// The sd of what irregularities do to the log density of a render, nats.
  double luck_at_the_mode() {
    constexpr Eigen::Index kRenders = 32;
    evaluate(mode_(informed_).replicate(1, kRenders));
    const Eigen::VectorXd energies = known_.all().energies().tail(kRenders);
    return std::sqrt((energies.array() - energies.mean()).square().sum() / (kRenders - 1));
  }

  /// From where on polynomials promise no more than a render has to show: a nat above what the better quarter
  /// of their draws have, less where a render itself is a matter of luck. The less is allowed, the less of a
  /// draw is theirs, and the more evaluations it takes: at a nat about four (tests/bench/README.md has means
  /// and errors by what is allowed).
  static double allowance(const std::vector<double>& deeper, double luck) {
    constexpr double kAbove = 1, kOfLuck = 1.0 / 3;  // nats; of the luck
    return quantile(deeper, 0.25) - kAbove + kOfLuck * luck;
  }

  /// Of draws, by a render that may be deeper by so much (VettedDensity).
  static double share_taken(const std::vector<double>& deeper, double allowed) {
    const auto taken = [&](double by) { return std::exp(std::min(allowed - by, 0.0)); };
    return std::transform_reduce(deeper.begin(), deeper.end(), 0.0, std::plus(), taken) /
           static_cast<double>(deeper.size());
  }

  /// The share of places about as deep as the better ones: those that are not promised in vain.
  static double share_kept(const std::vector<double>& deeper) {
    constexpr double kInVain = 4;  // nats, several times what luck does
    const double allowed = quantile(deeper, 0.25) + kInVain;
    const auto within = std::ranges::count_if(deeper, [&](double by) { return by <= allowed; });
    return static_cast<double>(within) / static_cast<double>(deeper.size());
  }

  static double quantile(std::vector<double> values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::ranges::nth_element(values, at);
    return *at;
  }

  void fit() { emulator_ = Emulator(known_.worth_learning(first_), axes_, sides_); }

  /// Along which informed coordinate the basins lie on both sides of the middle, furthest apart; none where
  /// none do by a prior sd.
  std::optional<Eigen::Index> two_sided(const std::vector<ChainState>& starts) const {
    double furthest = 1;  // prior sds
    std::optional<Eigen::Index> along;
    for (std::size_t k = 1; k < settings_.basins; ++k) {
      const Eigen::VectorXd there = starts[k].position.continuous(informed_), here = mode_(informed_);
      for (Eigen::Index i = 0; i < here.size(); ++i)
        if (here[i] * there[i] < 0 && std::abs(there[i] - here[i]) > furthest) {
          furthest = std::abs(there[i] - here[i]);
          along = i;
        }
    }
    return along;
  }

  /// About the mode, and as many about other basins as good, in turn.
  Eigen::MatrixXd about_the_basins() {
    constexpr double kSpread = 1.2;  // Laplace's sds
    Eigen::MatrixXd places(std::ssize(informed_), first_);
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      const Position& basin = walkers_[static_cast<std::size_t>(i) % settings_.basins].state.position;
      places.col(i) =
          basin.continuous(informed_) + kSpread * informed_laplace_.colour(rng_.normals(places.rows()));
    }
    return places;
  }

  /// What no place was tried about, no draw of the emulator may ever come to: without these an end of
  /// leather_6's posterior, power above .4, was thought empty.
  Eigen::MatrixXd about_the_starts() {
    constexpr Eigen::Index kEach = 10;
    constexpr double kSpread = 0.5;  // Laplace's sds
    Eigen::MatrixXd places(std::ssize(informed_), kEach * std::ssize(walkers_));
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      const Position& start = walkers_[static_cast<std::size_t>(i / kEach)].state.position;
      places.col(i) =
          start.continuous(informed_) + kSpread * informed_laplace_.colour(rng_.normals(places.rows()));
    }
    return places;
  }

  /// So many draws, hardly depending on each other, of the prior and the emulated likelihood to some power:
  /// were all of the emulator itself, it would never learn of tails that it thinks too little of. From the
  /// walkers' places, any of them: were all from the mode, it would never learn that another match of its own
  /// is none, and chains that come to it would stay (flake_4).
  /// @param beta  inverse temperature of the likelihood
  Eigen::MatrixXd softened_draws(int count, double beta) {
    constexpr int kChains = 4, kApart = 10;
    SampleSettings settings;
    settings.chains = kChains;
    settings.warmup = 300;
    settings.draws = kApart * ((count + kChains - 1) / kChains);
    settings.seed = rng_();
    settings.noise_repeats = 0;
    settings.threads = settings_.threads;
    const TemperedDensity wide(emulator_, beta);
    auto kernel = make_kernel("hmc", wide, 1, usual_refresh(/*has_jagged=*/false), "joint", kPathLength);
    if (sides_) kernel = with_mirror_moves(std::move(kernel), *sides_);
    const Sample sample = patina::sample(
        wide, *kernel, settings,
        [&](Rng& rng) {
          const Walker& walker = walkers_[static_cast<std::size_t>(rng.below(kEmulatorWalkers))];
          return Position{walker.state.position.continuous(informed_), {}};
        },
        informed_laplace_);
    metric_ = with_informed(beta * pooled(sample));
    Eigen::MatrixXd draws(std::ssize(informed_), count);
    for (Eigen::Index i = 0; i < draws.rows(); ++i)
      for (Eigen::Index j = 0; j < count; ++j)
        draws(i, j) = sample.coordinates[static_cast<std::size_t>(i)]((j / kChains) * kApart, j % kChains);
    return draws;
  }

  /// The covariance of all draws.
  static Eigen::MatrixXd pooled(const Sample& wide) {
    const Eigen::Index d = std::ssize(wide.coordinates);
    Eigen::MatrixXd all(wide.log_density.size(), d);
    for (Eigen::Index i = 0; i < d; ++i)
      all.col(i) = wide.coordinates[static_cast<std::size_t>(i)].reshaped();
    all.rowwise() -= all.colwise().mean().eval();
    return all.transpose() * all / static_cast<double>(all.rows());
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
    const EmulatedProposals proposals(for_proposals(emulator_), informed_, posterior_);
    const auto proposal = proposals.far(kPathLength), walk = make_walk_of(posterior_);
    const KernelSettings settings{.metric = metric_};
    const auto work = [&](std::size_t k) {
      Walker& walker = walkers_[k];
      walker.record = {};
      walker.taken = 0;
      const RecordingDensity target = recording(posterior_, walker.record);
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
  std::optional<Eigen::Index> sides_;
  std::vector<Walker> walkers_;  ///< the first begins at the mode
  KnownResiduals known_;
  Emulator emulator_;
};

}  // namespace

bool can_emulate(const Posterior& posterior) { return !posterior.informed().empty(); }

bool misses_one(const Emulator& emulator, const std::vector<Eigen::Index>& informed, const LogDensity& target,
                const ChainState& mode, const std::vector<ChainState>& places) {
  if (has_jagged(target)) return false;
  constexpr double kOff = 4;  // nats, several times what an emulator in use is off by
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

std::optional<AveragedEmulator> emulate_average(const Posterior& posterior,
                                                const std::vector<ChainState>& starts, const Metric& laplace,
                                                const EmulateSettings& settings) {
  return Learner(posterior, starts, laplace, settings, kEmulatorStream).learn_average();
}

Emulator emulate_about(const Posterior& posterior, const Eigen::MatrixXd& places, const KnownResiduals& known,
                       const ChainState& mode, const Metric& laplace, const EmulateSettings& settings) {
  return Learner(posterior, {mode}, laplace, settings, kAgainStream).learn_at(places, known);
}

}  // namespace patina
