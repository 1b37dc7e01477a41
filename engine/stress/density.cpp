#include "engine/stress/density.h"

#include <cmath>

#include "engine/error.h"
#include "engine/run/chain_start.h"
#include "engine/run/stopwatch.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/stress/judge.h"

namespace patina {
namespace {

constexpr double kAlpha = 0.8;  // as a run has it

struct Begun {
  Start start;
  Metric metric;
};

Begun begin_as_a_run(const LogDensity& target, const Demand& demand, const Attempt& attempt) {
  if (demand.start) return {demand.start, Metric::identity(target.dimension())};
  MapSearchSettings search;
  search.threads = attempt.threads;
  Rng rng(attempt.seed, 0);
  const OptimizerResult best = search_map({&target}, rng, search).best;
  if (!std::isfinite(best.evaluation.log_density))
    throw UserError("No place has a density: check the priors.");  // as a run does
  const Metric laplace(laplace_covariance(target, best.position));
  const ChainState mode{best.position, best.evaluation};
  return {[&target, mode, laplace](Rng& r) { return overdispersed_start(target, mode, laplace, r).position; },
          laplace};
}

std::vector<Draw> draws_of(const Sample& sample, const KnownPosterior& posterior) {
  std::vector<Draw> draws;
  const auto dimension = std::ssize(sample.coordinates), choices = std::ssize(sample.levels);
  for (Eigen::Index k = 0; k < sample.energy.cols(); ++k)
    for (Eigen::Index t = 0; t < sample.energy.rows(); ++t) {
      Position position{Eigen::VectorXd(dimension), Eigen::VectorXi(choices)};
      for (Eigen::Index i = 0; i < dimension; ++i) position.continuous[i] = sample.coordinates[i](t, k);
      for (Eigen::Index i = 0; i < choices; ++i)
        position.discrete[i] = static_cast<int>(sample.levels[i](t, k));
      draws.push_back({.chain = static_cast<int>(k),
                       .iteration = t,
                       .lp = sample.log_density(t, k),
                       .energy = sample.energy(t, k),
                       .accept_stat = sample.acceptance[static_cast<std::size_t>(k)],
                       .divergent = sample.divergent(t, k),
                       .values = posterior.values(position)});
    }
  return draws;
}

Evidence try_density(const KnownPosterior& posterior, const Demand& demand, const Attempt& attempt) {
  const LogDensity& target = *posterior.target;
  const Begun begun = begin_as_a_run(target, demand, attempt);
  const SampleSettings settings{.chains = demand.chains,
                                .warmup = demand.warmup,
                                .draws = demand.draws,
                                .seed = attempt.seed,
                                .metric = MetricKind::curved,
                                .metric_worth = 10.0 * static_cast<double>(target.dimension()),
                                .threads = attempt.threads};
  const double factor = demand.metric_factor * demand.metric_factor;
  const Sample sample = patina::sample(target, *make_kernel(attempt.kernel, target, kAlpha, demand.refresh),
                                       settings, begun.start, Metric(factor * begun.metric.covariance()));
  const std::vector<Draw> draws = draws_of(sample, posterior);
  Evidence evidence;
  evidence.summary = summarize_draws(posterior.table, draws);
  evidence.alarms = evidence.summary.alarms;
  if (const auto alarm = noise_alarm(sample.noise)) evidence.alarms.push_back(*alarm);
  evidence.error = worst_error(posterior.known, draws);
  return evidence;
}

}  // namespace

Scenario density_scenario(std::string name, std::string what, std::string known_by, Posed pose,
                          Demand demand) {
  return {std::move(name), std::move(what), std::move(known_by),
          [pose = std::move(pose), demand = std::move(demand)](const Attempt& attempt) {
            const KnownPosterior posterior = pose();
            double seconds = 0;
            Evidence evidence;
            {
              const Stopwatch stopwatch(seconds);
              evidence = try_density(posterior, demand, attempt);
            }
            evidence.seconds = seconds;
            return evidence;
          }};
}

KnownPosterior in_coordinates(Eigen::Index dimension, FunctionDensity::Function function,
                              std::vector<int> levels) {
  KnownPosterior posterior;
  posterior.table.material = "density";
  constexpr double kFar = 1000;  // no bound
  for (Eigen::Index i = 1; i <= dimension; ++i)
    posterior.table.continuous.push_back({"x" + std::to_string(i), "", "", {0, 1, -kFar, kFar}});
  for (std::size_t i = 0; i < levels.size(); ++i)
    posterior.table.discrete.push_back(
        {"c" + std::to_string(i + 1), "", std::vector<std::string>(static_cast<std::size_t>(levels[i]))});
  posterior.target = std::make_shared<FunctionDensity>(dimension, std::move(function), std::move(levels));
  posterior.values = [](const Position& p) {
    return ParameterValues{{p.continuous.begin(), p.continuous.end()},
                           {p.discrete.begin(), p.discrete.end()}};
  };
  return posterior;
}

Known parameter(const KnownPosterior& posterior, std::size_t index, double mean, double sd) {
  return {posterior.table.continuous[index].name,
          [index](const ParameterValues& values) { return values.continuous[index]; }, mean, sd};
}

Known choice(const KnownPosterior& posterior, std::size_t index, int level, double probability) {
  return {posterior.table.discrete[index].name,
          [=](const ParameterValues& values) { return values.discrete[index] == level ? 1.0 : 0.0; },
          probability, std::sqrt(probability * (1 - probability))};
}

}  // namespace patina
