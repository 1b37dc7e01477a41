#include "engine/calibration/study.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <utility>

#include "engine/calibration/coverage.h"
#include "engine/diagnostics/convergence.h"
#include "engine/error.h"
#include "engine/material/irregularities.h"
#include "engine/posterior/emulate.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/regressed_likelihood.h"
#include "engine/posterior/vetted_density.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/predicted_start.h"
#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Seeds of irregularities: no photo's are another photo's, a run's or among those simulated with.
constexpr std::uint64_t kPhotos = 2 * kSimulatedSeeds, kRuns = 3 * kSimulatedSeeds;
constexpr std::uint64_t kSeedsAStudy = 100'000;

/// A photo, and what is known of it.
struct Case {
  Image photo;
  std::shared_ptr<const Posterior> posterior;
  Position truth;
};

struct Target {
  std::shared_ptr<const LogDensity> density;
  Position mode;
  Eigen::MatrixXd covariance;
  std::unique_ptr<const Kernel> kernel;
  int warmup;
};

double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Posterior blank(const PosteriorSettings& settings) {
  return {settings, Image(settings.resolution, settings.resolution, 3)};
}

/// Of all that is drawn for a photo; photo 0 is the pilot.
std::uint64_t seed_of(const StudySettings& study, int photo) {
  return study.seed * kSeedsAStudy + static_cast<std::uint64_t>(photo);
}

Case make_case(const StudySettings& study, const Posterior& any, int photo, Rng& rng) {
  const std::uint64_t offset = seed_of(study, photo);
  PosteriorSettings settings = study.posterior;
  settings.z_seed = kRuns + offset;
  const Position truth = prior_draw(any, rng);
  Image taken = any.simulated_photo(truth, Irregularities(kPhotos + offset), study.camera, rng);
  auto posterior = std::make_shared<const Posterior>(settings, taken);
  return {std::move(taken), std::move(posterior), truth};
}

MapSearchResult search(const Posterior& posterior, Rng& rng) {
  MapSearchSettings settings;
  settings.prior_draws = 48;
  settings.descents = 4;
  settings.finalists = 2;
  return search_map({&posterior}, rng, settings);
}

constexpr double kContinuous = 0.8;

Target hand_set(std::shared_ptr<const Posterior> posterior, const StudySettings& study, Rng& rng) {
  Position mode = search(*posterior, rng).best.position;
  Eigen::MatrixXd laplace = laplace_covariance(*posterior, mode);
  auto kernel = make_kernel("mala", *posterior, kContinuous, 0.3);
  return {std::move(posterior), std::move(mode), std::move(laplace), std::move(kernel), study.warmup};
}

/// As a run has it (run/widened_errors.h, run/emulated_proposals.h), from the one match.
Target averaged(const Posterior& by_hand, IrregularityPool& pool, const StudySettings& study,
                std::uint64_t seed, Rng& rng) {
  const Position match = search(by_hand, rng).best.position;
  const Simulator simulator{.posterior = by_hand, .pool = pool, .camera = study.camera, .seed = seed};
  const WiderErrors wider = errors_of_irregularities(simulator, match);
  const Posterior widened = by_hand.with(wider);
  Position mode = maximize(widened, match).position;
  Eigen::MatrixXd laplace = laplace_covariance(widened, mode);
  const Posterior by_render = by_hand.with(wider.of_the_photo());
  const std::optional<AveragedEmulator> average = emulate_average(
      by_render, {{mode, by_render.value(mode)}}, Metric(laplace), {.seed = seed, .others = &pool});
  if (!average) throw UserError("Polynomials do not follow the renders of a photo: leave this material out.");
  std::shared_ptr<const VettedDensity> density = patina::averaged(by_hand, wider, *average);
  auto kernel = make_emulated_kernel(*density, RunSettings().path_length);
  return {std::move(density), std::move(mode), average->covariance, std::move(kernel),
          std::min(study.warmup, kAveragedWarmup)};
}

Target calibrated(const Calibration& found, const Posterior& posterior, const StudySettings& study,
                  PhotoOutcome& outcome) {
  outcome.distance = found.fit.distance;
  outcome.widening = found.fit.widening;
  outcome.simulated = found.photos;
  const Eigen::Index levels = std::ssize(posterior.discrete_levels());
  const double variance = study.error_scale * study.error_scale;
  auto density = std::make_shared<Posterior>(
      posterior.with(std::make_shared<const RegressedLikelihood>(found.likelihood.widened(variance))));
  // A likelihood that takes microseconds can afford the kernel that needs no tuning.
  auto kernel = make_kernel("nuts", *density, kContinuous, 0.5);
  return {std::move(density),
          {found.mode, Eigen::VectorXi::Zero(levels)},
          found.covariance,
          std::move(kernel),
          study.warmup};
}

/// Chains begin wider than the posterior, so that R-hat can tell.
Sample draw(const Target& target, const StudySettings& study, std::uint64_t seed) {
  constexpr double kOverdispersion = 1.5;
  const Metric metric(target.covariance);
  SampleSettings settings;
  settings.chains = study.chains;
  settings.warmup = target.warmup;
  settings.draws = study.draws;
  settings.seed = seed;
  settings.metric = MetricKind::curved;
  settings.metric_worth = 10.0 * static_cast<double>(target.density->dimension());
  const auto start = [&](Rng& rng) {
    Position position = target.mode;
    position.continuous += kOverdispersion * metric.colour(rng.normals(position.continuous.size()));
    return position;
  };
  return sample(*target.density, *target.kernel, settings, start, metric);
}

/// In sampling coordinates, where the prior's sd is 1 and places are those of the parameters' values.
void judge(const Sample& sample, const Case& example, const LogDensity& posterior, Rng& rng,
           PhotoOutcome& outcome) {
  const auto add = [&](const Eigen::MatrixXd& draws, double truth, double sd) {
    const double rhat = split_rhat(draws), ess = bulk_ess(draws);
    outcome.quantities.push_back({place_among(draws, truth, rng), sd, rhat});
    // Chains that never moved are the worst case, not none.
    outcome.worst_rhat = std::max(outcome.worst_rhat, std::isfinite(rhat) ? rhat : 99.0);
    outcome.least_ess = std::min(outcome.least_ess, std::isfinite(rhat) ? ess : 0.0);
  };
  outcome.least_ess = std::numeric_limits<double>::infinity();
  add(sample.log_density, value_finite(posterior, example.truth).log_density, kNaN);
  for (std::size_t i = 0; i < sample.coordinates.size(); ++i) {
    const Eigen::MatrixXd& draws = sample.coordinates[i];
    add(draws, example.truth.continuous[static_cast<Eigen::Index>(i)], standard_deviation(draws));
  }
}

}  // namespace

CalibrationStudy::CalibrationStudy(const StudySettings& settings, int threads,
                                   std::function<void()> enter_thread)
    : settings_(settings),
      blank_(blank(settings.posterior)),
      threads_(threads),
      enter_thread_(std::move(enter_thread)) {
  quantities_.emplace_back("lp");
  for (const Parameter& parameter : blank_.table().continuous)
    if (!settings.posterior.fixed.contains(parameter.name)) quantities_.push_back(parameter.name);
  if (settings.errors == "paper") return;
  pool_ = make_pool(blank_.table(), kSimulatedSeeds);
  if (settings.errors == "calibrated") guess_ = region_guess(blank_, settings.posterior.capture);
}

const Pilot& CalibrationStudy::pilot() const {
  std::call_once(pilot_made_, [&] {
    const Simulator simulator{.posterior = blank_,
                              .pool = *pool_,
                              .camera = settings_.camera,
                              .seed = seed_of(settings_, 0),
                              .threads = threads_,
                              .enter_thread = enter_thread_};
    pilot_.emplace(simulator, settings_.simulations.pilot);
  });
  return *pilot_;
}

PhotoOutcome CalibrationStudy::run(int photo) const {
  const double begin = processor_seconds();
  const std::uint64_t seed = seed_of(settings_, photo);
  Rng rng(settings_.seed, static_cast<std::uint64_t>(photo));
  PhotoOutcome outcome;
  outcome.photo = photo;
  outcome.distance = kNaN;
  Case example = make_case(settings_, blank_, photo, rng);
  const auto target_of = [&] {
    if (settings_.errors == "paper") return hand_set(example.posterior, settings_, rng);
    if (settings_.errors == "averaged") return averaged(*example.posterior, *pool_, settings_, seed, rng);
    const Simulator simulator{.posterior = *example.posterior,
                              .pool = *pool_,
                              .camera = settings_.camera,
                              .seed = seed,
                              .guess = guess_};
    const OnDemand on_demand{
        .pilot = [&]() -> const Pilot& { return pilot(); },
        .match = [&] { return search(*example.posterior, rng).best.position.continuous; }};
    const Calibration found = calibrate(simulator, example.photo, on_demand, settings_.simulations);
    return calibrated(found, *example.posterior, settings_, outcome);
  };
  const Target target = target_of();
  const Sample sample = draw(target, settings_, seed);
  judge(sample, example, *target.density, rng, outcome);
  outcome.seconds = processor_seconds() - begin;
  return outcome;
}

}  // namespace patina
