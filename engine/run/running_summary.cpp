#include "engine/run/running_summary.h"

#include <cassert>
#include <cmath>

namespace patina {

RunningSummary::RunningSummary(const ParameterTable& table)
    : continuous_(table.continuous.size()),
      discrete_(table.discrete.size()),
      quantities_(1 + continuous_ + discrete_) {}

void RunningSummary::add(const Draw& draw) {
  const ParameterValues& values = draw.values;
  if (draw.warmup || values.continuous.size() != continuous_ || values.discrete.size() != discrete_) return;
  auto quantity = quantities_.begin();
  quantity++->add(draw.chain, draw.lp);
  for (const double value : values.continuous) quantity++->add(draw.chain, value);
  for (const int level : values.discrete) quantity++->add(draw.chain, level);
  if (chains_.size() <= static_cast<std::size_t>(draw.chain))
    chains_.resize(static_cast<std::size_t>(draw.chain) + 1);
  ChainCount& chain = chains_[static_cast<std::size_t>(draw.chain)];
  ++chain.draws;
  chain.divergences += draw.divergent;
  chain.acceptance_sum += draw.accept_stat;
}

void RunningSummary::update(RunSummary& summary) const {
  assert(summary.quantities.size() == quantities_.size());
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    QuantitySummary& quantity = summary.quantities[i];
    const ConvergenceFigures figures = quantities_[i].figures();
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
    const ChainCount& count = chains_[static_cast<std::size_t>(chain.chain)];
    chain.draws = count.draws;
    chain.divergences = count.divergences;
    chain.acceptance = count.acceptance_sum / static_cast<double>(count.draws);
  }
}

std::size_t RunningSummary::bytes() const {
  std::size_t bytes = 0;
  for (const RunningConvergence& quantity : quantities_) bytes += quantity.bytes();
  return bytes;
}

}  // namespace patina
