// What a run's average over irregularities (engine/posterior/vetted_density.h) gains and loses by how much
// polynomials may promise above what one render has: of draws of the polynomials alone the share that is
// taken, and how far from the mean of renders those are that are taken.
// Nats are beyond the depth that the better quarter of renders have at draws of the polynomials.
//   bench-allowance RUN [DRAWS = 400 [IRREGULARITIES = 24]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "engine/allocator.h"
#include "engine/error.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/sample.h"
#include "tests/bench/mean_of_renders.h"

namespace patina {
namespace {

/// Of the polynomials' distribution, from the run's basins. @return [dimension, count]
Eigen::MatrixXd draws_of(const Emulator& emulator, const Metric& metric,
                         const std::vector<Eigen::VectorXd>& basins, Eigen::Index count) {
  constexpr int kChains = 4, kApart = 10;
  SampleSettings settings;
  settings.chains = kChains;
  settings.warmup = 300;
  settings.draws = kApart * static_cast<int>((count + kChains - 1) / kChains);
  settings.noise_repeats = 0;
  settings.threads = hardware_threads();
  auto kernel = make_kernel("hmc", emulator, 1, usual_refresh(/*has_jagged=*/false), "joint", 1.5);
  if (const auto sides = emulator.sides()) kernel = with_mirror_moves(std::move(kernel), *sides);
  const Sample sample = patina::sample(
      emulator, *kernel, settings,
      [&](Rng& rng) {
        return Position{basins[static_cast<std::size_t>(rng.below(static_cast<int>(basins.size())))], {}};
      },
      metric);
  Eigen::MatrixXd draws(emulator.dimension(), count);
  for (Eigen::Index i = 0; i < draws.rows(); ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      draws(i, j) = sample.coordinates[static_cast<std::size_t>(i)]((j / kChains) * kApart, j % kChains);
  return draws;
}

/// Of draws of the polynomials.
struct Shown {
  Eigen::MatrixXd draws;    ///< [dimension, n]
  Eigen::VectorXd by_mean;  ///< log density by the mean of renders less the polynomials', n
  Eigen::MatrixXd by_one;   ///< by each render alone, [n, irregularities]
};

Shown shown_at(const Eigen::MatrixXd& draws, const Emulator& emulator, const Posterior& posterior,
               std::size_t irregularities) {
  const MeanOfRenders mean(posterior, irregularities);
  const std::vector<Eigen::Index> informed = posterior.informed();
  Shown shown{draws, Eigen::VectorXd(draws.cols()),
              Eigen::MatrixXd(draws.cols(), static_cast<Eigen::Index>(irregularities))};
  parallel_for(
      static_cast<std::size_t>(draws.cols()), hardware_threads(),
      [&](std::size_t i) {
        Rng rng(1, i);
        const auto row = static_cast<Eigen::Index>(i);
        Position position{Eigen::VectorXd::Zero(posterior.dimension()), {}};
        position.continuous(informed) = draws.col(row);
        const MeanOfRenders::Value value = mean.at(position, rng);
        const double promised = emulator.value({draws.col(row), {}}).log_density;
        const double prior = -draws.col(row).squaredNorm() / 2;
        shown.by_mean[row] = value.log_density - promised;
        shown.by_one.row(row) = value.of_one.array() + prior - promised;
      },
      [] { use_tensor_threads(1); });
  return shown;
}

/// What irregularities do to the log density of a render, an sd in nats.
double luck_at(const Position& place, const Posterior& posterior, std::size_t irregularities) {
  Rng rng(1);
  const Eigen::RowVectorXd of_one = MeanOfRenders(posterior, irregularities).at(place, rng).of_one;
  return std::sqrt((of_one.array() - of_one.mean()).square().sum() / static_cast<double>(of_one.size() - 1));
}

double quantile(Eigen::MatrixXd values, double share) {
  const auto at = values.data() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.data(), at, values.data() + values.size());
  return *at;
}

struct Judged {
  double taken = 0, nats_off = 0, worst_mean = 0;  ///< means over the irregularities
};

Judged judged(const Shown& shown, double allowed) {
  Judged all;
  const auto z = static_cast<double>(shown.by_one.cols());
  for (const auto one : shown.by_one.colwise()) {
    const Eigen::ArrayXd log_share = (one.array() + allowed).min(0.0),
                         off = shown.by_mean.array() - log_share;
    const Eigen::ArrayXd share = log_share.exp(), weight = share / share.sum();
    const Eigen::ArrayXd apart = off - (weight * off).sum();
    all.taken += share.mean() / z;
    all.nats_off += std::sqrt((weight * apart.square()).sum()) / z;
    double worst = 0;
    for (const auto u : shown.draws.rowwise()) {
      const Eigen::ArrayXd x = u.transpose().array(), from_mean = x - (weight * x).sum();
      worst = std::max(worst, std::abs((weight * from_mean * apart).sum()) /
                                  std::sqrt((weight * from_mean.square()).sum()));
    }
    all.worst_mean += worst / z;
  }
  return all;
}

void report(const std::filesystem::path& directory, Eigen::Index count, std::size_t irregularities) {
  const Manifest manifest = read_manifest(directory);
  const RunSettings& settings = manifest.settings;
  const Posterior by_hand(posterior_settings(settings, settings.resolution), read_run_photo(directory));
  const auto found = read_mode(directory, run_key(manifest), by_hand, settings);
  if (!found || !found->average) throw UserError("The run has no average over irregularities.");
  const Posterior posterior = by_hand.with(found->wider->of_the_photo());
  const std::vector<Eigen::Index> informed = posterior.informed();
  std::vector<Eigen::VectorXd> basins;
  for (const MapPoint& basin : manifest.basins)
    basins.push_back(by_hand.position(basin.values).continuous(informed));
  const Emulator& emulator = found->average->emulator;
  const Metric metric(Eigen::MatrixXd(found->average->covariance(informed, informed)));
  const Shown shown =
      shown_at(draws_of(emulator, metric, basins, count), emulator, posterior, irregularities);
  const double better_quarter = -quantile(shown.by_one, 0.75);
  std::printf("irregularities do %.1f nats to a render at the match; allowed by the run: %+.1f\n",
              luck_at(found->mode.position, posterior, irregularities),
              found->average->allowance - better_quarter);
  std::printf("%28s %14s %14s %14s\n", "nats allowed", "share taken", "nats off", "worst mean");
  for (const double beyond : {-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0, 8.0, 20.0}) {
    const Judged by = judged(shown, better_quarter + beyond);
    std::printf("%28.0f %14.2f %14.2f %14.2f\n", beyond, by.taken, by.nats_off, by.worst_mean);
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "bench-allowance RUN [DRAWS [IRREGULARITIES]]\n");
    return 2;
  }
  try {
    patina::report(argv[1], argc > 2 ? std::atol(argv[2]) : 400,
                   argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 24);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
