// How right a run's average over irregularities is (engine/posterior/vetted_density.h): at some of its draws
// the log density by the mean summary of renders with irregularities that nothing was learnt from, against
// the one that they were drawn from, and what becomes of means and sds if it is right; and how far a single
// render is from that mean, beside what its irregularities do everywhere.
//   bench-average RUN [DRAWS = 200 [IRREGULARITIES = 48]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "engine/allocator.h"
#include "engine/diagnostics/convergence.h"
#include "engine/diagnostics/reweighting.h"
#include "engine/error.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "engine/run/threads.h"
#include "engine/sampling/parallel_for.h"
#include "tests/bench/mean_of_renders.h"

namespace patina {
namespace {

/// After warm-up, as far apart as may be.
std::vector<Draw> thinned(const std::filesystem::path& directory, std::size_t count) {
  std::vector<Draw> draws = open_run(directory)->take_draws(), kept;
  std::erase_if(draws, [](const Draw& draw) { return draw.warmup; });
  if (draws.size() < count) throw UserError("The run has fewer draws after its warm-up than are asked for.");
  for (std::size_t i = 0; i < count; ++i) kept.push_back(draws[i * draws.size() / count]);
  return kept;
}

/// Of what is left of a table without the means of its rows and columns.
double interaction(Eigen::MatrixXd table) {
  table.colwise() -= table.rowwise().mean().eval();
  table.rowwise() -= table.colwise().mean().eval();
  return table.norm() / std::sqrt(static_cast<double>((table.rows() - 1) * (table.cols() - 1)));
}

void report(const std::filesystem::path& directory, std::size_t count, std::size_t irregularities) {
  const Manifest manifest = read_manifest(directory);
  const RunSettings& settings = manifest.settings;
  const Posterior by_hand(posterior_settings(settings, settings.resolution), read_run_photo(directory));
  const auto found = read_mode(directory, run_key(manifest), by_hand, settings);
  if (!found || !found->average) throw UserError("The run has no average over irregularities.");
  const Posterior posterior = by_hand.with(found->wider->of_the_photo());
  const std::vector<Eigen::Index> informed = posterior.informed();
  const MeanOfRenders mean(posterior, irregularities);

  const std::vector<Draw> draws = thinned(directory, count);
  const auto n = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd places(n, std::ssize(informed));
  Eigen::MatrixXd of_one(n, static_cast<Eigen::Index>(irregularities));
  Eigen::VectorXd log_ratio(n), by_chance(n);
  std::vector<char> vetoed(count);
  parallel_for(
      count, hardware_threads(),
      [&](std::size_t i) {
        constexpr double kRounding = 1e-3;  // nats
        Rng rng(1, i);
        const Position position = posterior.position(draws[i].values);
        const Eigen::VectorXd place = position.continuous(informed);
        const double others = (position.continuous.squaredNorm() - place.squaredNorm()) / 2;
        const double drawn_from = draws[i].lp + others;
        const MeanOfRenders::Value value = mean.at(position, rng);
        const auto row = static_cast<Eigen::Index>(i);
        places.row(row) = place;
        log_ratio[row] = value.log_density - drawn_from;
        by_chance[row] = value.by_chance;
        of_one.row(row) = value.of_one;
        vetoed[i] = drawn_from < found->average->emulator.value({place, {}}).log_density - kRounding;
      },
      [] { use_tensor_threads(1); });

  std::printf(
      "%zu draws, %zu other irregularities: log ratios have an sd of %.2f nats, %.2f of it by chance; "
      "%.1f %% of the draws vetoed; single renders scatter by %.2f nats\n",
      count, irregularities, standard_deviation(log_ratio), std::sqrt(by_chance.squaredNorm() / double(n)),
      100.0 * double(std::ranges::count(vetoed, 1)) / double(n), interaction(of_one));
  std::printf("%-20s %28s %28s\n", "", "mean is off by, in sds", "sd is off by, logarithm");
  std::vector<const Parameter*> free;
  for (const Parameter& parameter : posterior.table().continuous)
    if (!settings.fixed.contains(parameter.name)) free.push_back(&parameter);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Reweighting by = reweight(places.col(i), log_ratio, static_cast<double>(n));
    std::printf("%-20s %15.2f +- %.2f %19.2f +- %.2f\n",
                free[static_cast<std::size_t>(informed[static_cast<std::size_t>(i)])]->name.c_str(),
                by.mean_shift, by.mean_error, by.log_spread, by.spread_error);
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "bench-average RUN [DRAWS [IRREGULARITIES]]\n");
    return 2;
  }
  try {
    patina::report(argv[1], argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 200,
                   argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 48);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
