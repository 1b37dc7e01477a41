#include "gui/mode_finder.h"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/diagnostics/modes.h"

namespace patina {
namespace {

constexpr std::size_t kMostDraws = 3000;

/// Draws as the search takes them.
struct Sample {
  std::vector<std::size_t> draws;
  std::vector<double> lp;
  Eigen::MatrixXd continuous;
  Eigen::MatrixXi discrete;
};

Sample sample_of(const ExplorerModel& model) {
  const DrawColumns& all = model.draws();
  Sample sample;
  const std::size_t stride = all.size() / kMostDraws + 1;
  for (std::size_t draw = 0; draw < all.size(); draw += stride) {
    if (!model.in_answer(draw)) continue;
    sample.draws.push_back(draw);
    sample.lp.push_back(all.lp(draw));
  }
  const auto rows = static_cast<Eigen::Index>(sample.draws.size());
  sample.continuous.resize(rows, static_cast<Eigen::Index>(model.table().continuous.size()));
  sample.discrete.resize(rows, static_cast<Eigen::Index>(model.table().discrete.size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const ParameterValues values = all.values(sample.draws[static_cast<std::size_t>(row)]);
    for (Eigen::Index i = 0; i < sample.continuous.cols(); ++i)
      sample.continuous(row, i) = values.continuous[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 0; i < sample.discrete.cols(); ++i)
      sample.discrete(row, i) = values.discrete[static_cast<std::size_t>(i)];
  }
  return sample;
}

std::vector<FoundMode> search(const Sample& sample) {
  std::vector<FoundMode> found;
  for (const Mode& mode : find_modes(sample.continuous, sample.discrete)) {
    const auto lp = [&](Eigen::Index row) { return sample.lp[static_cast<std::size_t>(row)]; };
    const Eigen::Index best = *std::ranges::max_element(mode.members, {}, lp);
    found.push_back({static_cast<double>(mode.members.size()) / static_cast<double>(sample.draws.size()),
                     sample.draws[static_cast<std::size_t>(best)]});
  }
  return found;
}

}  // namespace

void ModeFinder::follow(const ExplorerModel& model, int run) {
  if (run != run_) {
    run_ = run;
    draws_ = 0;
    modes_.clear();
  }
  if (search_.valid()) {
    if (search_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    auto found = search_.get();
    if (search_run_ == run_) modes_ = std::move(found);
  }
  const std::size_t answer =
      model.draws().sampling_count() > 0 ? model.draws().sampling_count() : model.draws().size();
  if (answer < kLeastDraws || answer < draws_ + draws_ / 4 || answer == draws_) return;
  draws_ = answer;
  search_run_ = run_;
  search_ = std::async(std::launch::async, [sample = sample_of(model), wake = wake_] {
    auto found = search(sample);
    wake();
    return found;
  });
}

}  // namespace patina
