#include "engine/run/summarize.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "engine/diagnostics/convergence.h"
#include "engine/diagnostics/principal_directions.h"
#include "engine/format.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/draw_alarms.h"
#include "engine/run/draw_matrix.h"

namespace patina {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

QuantitySummary summarize(const std::string& name, const Eigen::MatrixXd& values, double prior_sd) {
  QuantitySummary s;
  s.name = name;
  s.mean = values.size() > 0 ? values.mean() : kNaN;
  s.sd = values.size() > 1 ? standard_deviation(values) : kNaN;
  s.q5 = quantile(values, 0.05);
  s.q25 = quantile(values, 0.25);
  s.q50 = quantile(values, 0.5);
  s.q75 = quantile(values, 0.75);
  s.q95 = quantile(values, 0.95);
  s.mcse_mean = mcse_mean(values);
  s.mcse_sd = mcse_sd(values);
  s.bulk_ess = bulk_ess(values);
  s.tail_ess = tail_ess(values);
  s.rhat = split_rhat(values);
  s.sd_over_prior_sd = s.sd / prior_sd;
  return s;
}

std::vector<ChainMean> chain_means(const DrawsByChain& chains, const Eigen::MatrixXd& values) {
  std::vector<ChainMean> means;
  for (std::size_t k = 0; k < chains.size(); ++k)
    if (!chains[k].empty())
      means.push_back({static_cast<int>(k), values.col(static_cast<Eigen::Index>(means.size())).mean()});
  return means;
}

/// The sum of the largest loadings, in units of the first: "height - 0.8 power".
std::string name_of(const Eigen::VectorXd& loadings, const ParameterTable& table) {
  constexpr double kSmall = 0.5;  // of the largest
  std::vector<Eigen::Index> order(static_cast<std::size_t>(loadings.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, std::greater(), [&](Eigen::Index i) { return std::abs(loadings[i]); });
  std::string name;
  for (const Eigen::Index i : order) {
    const double weight = loadings[i] / loadings[order.front()];
    if (std::abs(weight) < kSmall) break;
    if (!name.empty()) name += format(" %c %.1f ", weight < 0 ? '-' : '+', std::abs(weight));
    name += table.continuous[static_cast<std::size_t>(i)].name;
  }
  return name;
}

std::vector<DirectionSummary> summarize_directions(const DrawsByChain& chains, const ParameterTable& table) {
  constexpr int kDirections = 3;
  const std::vector<Eigen::MatrixXd> coordinates = coordinates_of(chains, table);
  if (coordinates.empty() || coordinates.front().size() == 0) return {};
  const Eigen::Index iterations = coordinates.front().rows(), columns = coordinates.front().cols();
  Eigen::MatrixXd draws(iterations * columns, std::ssize(coordinates));
  for (Eigen::Index i = 0; i < draws.cols(); ++i)
    draws.col(i) = coordinates[static_cast<std::size_t>(i)].reshaped();
  std::vector<DirectionSummary> summaries;
  for (const PrincipalDirection& direction : principal_directions(draws, kDirections)) {
    const Eigen::MatrixXd values = along(direction, draws).reshaped(iterations, columns);
    summaries.push_back({name_of(direction.loadings, table),
                         {direction.loadings.begin(), direction.loadings.end()},
                         direction.share,
                         bulk_ess(values),
                         tail_ess(values),
                         split_rhat(values)});
  }
  return summaries;
}

/// The energies of the draws that trajectories made; empty where no kernel makes any.
std::vector<double> trajectory_energies(const std::vector<const Draw*>& draws) {
  constexpr std::size_t kFewest = 4;
  std::vector<double> energies;
  for (const Draw* draw : draws)
    if (std::isfinite(draw->energy) && draw->energy != -draw->lp) energies.push_back(draw->energy);
  if (energies.size() < kFewest) energies.clear();
  return energies;
}

ChainSummary summarize_chain(int chain, const std::vector<const Draw*>& draws) {
  ChainSummary s;
  s.chain = chain;
  s.draws = static_cast<std::int64_t>(draws.size());
  double acceptance = 0;
  for (const Draw* draw : draws) {
    acceptance += draw->accept_stat;
    s.divergences += draw->divergent;
  }
  s.acceptance = acceptance / static_cast<double>(draws.size());
  std::vector<double> energy = trajectory_energies(draws);
  s.has_trajectories = !energy.empty();
  if (energy.empty())
    for (const Draw* draw : draws) energy.push_back(-draw->lp);
  s.ebfmi = ebfmi(Eigen::Map<const Eigen::VectorXd>(energy.data(), std::ssize(energy)));
  return s;
}

}  // namespace

RunSummary summarize_draws(const ParameterTable& table, const std::vector<Draw>& draws) {
  const DrawsByChain chains = by_chain(draws);
  RunSummary summary;
  const auto add = [&](const std::string& name, double prior_sd,
                       const std::function<double(const Draw&)>& of) {
    const Eigen::MatrixXd values = matrix_of(chains, of);
    summary.quantities.push_back(summarize(name, values, prior_sd));
    summary.quantities.back().chain_means = chain_means(chains, values);
  };
  add("lp", kNaN, [](const Draw& draw) { return draw.lp; });
  for (std::size_t i = 0; i < table.continuous.size(); ++i)
    add(table.continuous[i].name, truncated_sd(table.continuous[i].prior),
        [i](const Draw& draw) { return draw.values.continuous[i]; });
  for (std::size_t i = 0; i < table.discrete.size(); ++i)
    add(table.discrete[i].name, kNaN,
        [i](const Draw& draw) { return static_cast<double>(draw.values.discrete[i]); });
  summary.directions = summarize_directions(chains, table);
  for (std::size_t k = 0; k < chains.size(); ++k)
    summary.chains.push_back(summarize_chain(static_cast<int>(k), chains[k]));
  summary.alarms = draw_alarms(table, summary, chains);
  return summary;
}

}  // namespace patina
