#include "engine/run/running_summary.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/diagnostics/running_convergence.h"

namespace patina {

struct RunningSummary::State {
  struct ChainCount {
    std::int64_t draws = 0, divergences = 0;
    double acceptance_sum = 0;
  };

  std::size_t continuous, discrete;
  std::vector<RunningConvergence> quantities;  ///< lp first, then the table's order
  std::vector<ChainCount> chains;
};

RunningSummary::RunningSummary(const ParameterTable& table)
    : state_(std::make_unique<State>(State{table.continuous.size(), table.discrete.size(), {}, {}})) {
  state_->quantities.resize(1 + state_->continuous + state_->discrete);
}

RunningSummary::~RunningSummary() = default;
RunningSummary::RunningSummary(RunningSummary&&) noexcept = default;
RunningSummary& RunningSummary::operator=(RunningSummary&&) noexcept = default;

void RunningSummary::add(const Draw& draw) {
  auto& [continuous, discrete, quantities, chains] = *state_;
  const ParameterValues& values = draw.values;
  if (draw.warmup || values.continuous.size() != continuous || values.discrete.size() != discrete) return;
  auto quantity = quantities.begin();
  quantity++->add(draw.chain, draw.lp);
  for (const double value : values.continuous) quantity++->add(draw.chain, value);
  for (const int level : values.discrete) quantity++->add(draw.chain, level);
  if (chains.size() <= static_cast<std::size_t>(draw.chain))
    chains.resize(static_cast<std::size_t>(draw.chain) + 1);
  State::ChainCount& chain = chains[static_cast<std::size_t>(draw.chain)];
  ++chain.draws;
  chain.divergences += draw.divergent;
  chain.acceptance_sum += draw.accept_stat;
}

void RunningSummary::update(RunSummary& summary) const {
  assert(summary.quantities.size() == state_->quantities.size());
  for (std::size_t i = 0; i < state_->quantities.size(); ++i) {
    QuantitySummary& quantity = summary.quantities[i];
    const ConvergenceFigures figures = state_->quantities[i].figures();
    if (quantity.sd > 0) quantity.sd_over_prior_sd *= figures.sd / quantity.sd;
    quantity.mean = figures.mean;
    quantity.sd = figures.sd;
    quantity.rhat = figures.rhat;
    quantity.bulk_ess = figures.bulk_ess;
    quantity.tail_ess = figures.tail_ess;
    quantity.mcse_mean = figures.sd / std::sqrt(figures.mean_ess);
    quantity.chain_means.clear();
    for (std::size_t k = 0; k < figures.chain_means.size(); ++k)
      if (!std::isnan(figures.chain_means[k]))
        quantity.chain_means.push_back({static_cast<int>(k), figures.chain_means[k]});
  }
  for (ChainSummary& chain : summary.chains) {
    const State::ChainCount& count = state_->chains[static_cast<std::size_t>(chain.chain)];
    chain.draws = count.draws;
    chain.divergences = count.divergences;
    chain.acceptance = count.acceptance_sum / static_cast<double>(count.draws);
  }
}

std::size_t RunningSummary::bytes() const {
  std::size_t bytes = 0;
  for (const RunningConvergence& quantity : state_->quantities) bytes += quantity.bytes();
  return bytes;
}

}  // namespace patina
