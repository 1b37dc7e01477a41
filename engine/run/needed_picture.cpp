#include "engine/run/needed_picture.h"

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "engine/diagnostics/convergence.h"
#include "engine/diagnostics/reweighting.h"
#include "engine/error.h"
#include "engine/format.h"
#include "engine/posterior/posterior.h"
#include "engine/run/draw_matrix.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/threads.h"
#include "engine/sampling/parallel_for.h"
#include "engine/summary/summary.h"
#include "engine/summary/summary_name.h"

namespace patina {
namespace {

constexpr int kLeastSearchSide = 32;
constexpr double kSameDensity = 0.01;  // nats, relative to 1 + |lp|: what float32 and another processor do

/// Log densities of the same positions under one posterior, and the median time of one.
struct Evaluated {
  Eigen::VectorXd log_density;
  double seconds = 0;
};

Evaluated evaluate(const Posterior& posterior, const std::vector<const Draw*>& draws) {
  Evaluated result{Eigen::VectorXd(std::ssize(draws)), 0};
  std::vector<double> seconds(draws.size());
  const auto work = [&](std::size_t i) {
    using Clock = std::chrono::steady_clock;
    const Position position = posterior.position(draws[i]->values);
    const auto begin = Clock::now();
    result.log_density[static_cast<Eigen::Index>(i)] = posterior.value(position).log_density;
    seconds[i] = std::chrono::duration<double>(Clock::now() - begin).count();
  };
  parallel_for(draws.size(), hardware_threads(), work, [] { use_tensor_threads(1); });
  std::ranges::nth_element(seconds, seconds.begin() + std::ssize(seconds) / 2);
  result.seconds = seconds[seconds.size() / 2];
  return result;
}

/// So many draws after warm-up, evenly from all chains.
std::vector<const Draw*> spread_out(const std::vector<Draw>& draws, int count) {
  std::vector<const Draw*> all, chosen;
  for (const auto& chain : by_chain(draws)) all.insert(all.end(), chain.begin(), chain.end());
  if (std::ssize(all) < count)
    throw UserError("There are " + std::to_string(all.size()) + " draws after warm-up, and " +
                    std::to_string(count) + " are needed to compare pictures: draw more.");
  for (int i = 0; i < count; ++i)
    chosen.push_back(all[all.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(count)]);
  return chosen;
}

/// The same posterior by a cheaper picture, held against that of the run.
class Comparer {
 public:
  Comparer(const RunSettings& settings, const Image& photo, const std::vector<Draw>& draws, int pairs)
      : settings_(settings), photo_(photo), chosen_(spread_out(draws, pairs)) {
    const Posterior posterior = posterior_of(settings.resolution, settings.summary);
    whole_ = evaluate(posterior, chosen_);
    check_densities();
    const DrawsByChain chains = by_chain(draws);
    const std::vector<Eigen::MatrixXd> coordinates = coordinates_of(chains, posterior.table());
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      if (coordinates[i].maxCoeff() == coordinates[i].minCoeff()) continue;
      names_.push_back(posterior.table().continuous[i].name);
      effective_.push_back(std::min<double>(pairs, mean_ess(coordinates[i])));
      columns_.push_back(chosen_coordinates(posterior.table(), i));
    }
  }

  CheaperPicture compare(int resolution, const std::string& summary) const {
    const Evaluated cheaper = evaluate(posterior_of(resolution, summary), chosen_);
    CheaperPicture result;
    result.resolution = resolution;
    result.summary = summary;
    result.times_as_fast = whole_.seconds / cheaper.seconds;
    result.agrees = true;
    const auto judge = [&](const std::string& what, double difference, double error) {
      result.agrees = result.agrees && std::abs(difference) + 2 * error <= kTolerance;
      if (!result.differs_most.empty() && std::abs(difference) <= std::abs(result.difference)) return;
      result.differs_most = what;
      result.difference = difference;
      result.error = error;
    };
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Reweighting moved =
          reweight(columns_[i], cheaper.log_density - whole_.log_density, effective_[i]);
      judge("mean of " + names_[i], moved.mean_shift, moved.mean_error);
      judge("sd of " + names_[i], moved.log_spread, moved.spread_error);
    }
    return result;
  }

  int least_resolution(const std::string& summary) const {
    return std::max(kLeastSearchSide, make_summary(summary, settings_.network)->minimum_resolution());
  }

 private:
  Posterior posterior_of(int resolution, const std::string& summary) const {
    PosteriorSettings settings = posterior_settings(settings_, resolution);
    settings.summary = summary;
    return Posterior(settings, photo_);
  }

  void check_densities() const {
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const double lp = chosen_[i]->lp, now = whole_.log_density[static_cast<Eigen::Index>(i)];
      if (!(std::abs(lp - now) <= kSameDensity * (1 + std::abs(lp))))
        throw UserError(
            format("A draw of this run has log density %.6g, and %.6g when it is evaluated now: ", lp, now) +
            "compare pictures with the version and the network that made the run.");
    }
  }

  Eigen::VectorXd chosen_coordinates(const ParameterTable& table, std::size_t parameter) const {
    std::vector<Draw> some;
    for (const Draw* draw : chosen_) {
      some.push_back(*draw);
      some.back().chain = 0;
    }
    return coordinates_of(by_chain(some), table)[parameter].reshaped();
  }

  const RunSettings& settings_;
  const Image& photo_;
  std::vector<const Draw*> chosen_;
  Evaluated whole_;
  std::vector<std::string> names_;  ///< of the parameters that vary, as the next two
  std::vector<double> effective_;   ///< draws among the chosen
  std::vector<Eigen::VectorXd> columns_;
};

/// Fewer than all of these pixels: about three quarters, a half, three eighths ...
std::vector<int> coarser(int resolution, int least) {
  std::vector<int> coarser;
  for (int half = resolution; half >= least; half /= 2)
    for (const int side : {half, half * 3 / 4})
      if (side < resolution && side >= least) coarser.push_back(side);
  return coarser;
}

}  // namespace

const CheaperPicture* NeededPicture::cheapest() const {
  const CheaperPicture* found = nullptr;
  for (const CheaperPicture& picture : tried)
    if (picture.agrees) found = &picture;
  return found;
}

std::string NeededPicture::sentence() const {
  const CheaperPicture* picture = cheapest();
  if (picture != nullptr)
    return format(
        "%d pixels and %s say the same of every parameter within %.1f of its spread, %.1f times as "
        "fast: fit with --resolution %d --summary %s.",
        picture->resolution, picture->summary.c_str(), kTolerance, picture->times_as_fast,
        picture->resolution, picture->summary.c_str());
  if (tried.empty()) return "There is no smaller picture to try.";
  return format("This photo needs all of its %d pixels and %s: with less, another posterior comes out.",
                resolution, summary.c_str());
}

NeededPicture needed_picture(const RunSettings& settings, const Image& photo, const std::vector<Draw>& draws,
                             int pairs, const std::function<void(const std::string&)>& progress) {
  if (settings.errors != "paper")
    throw UserError(
        "Pictures are compared for errors set by hand; this run's were measured at its own size: fit with "
        "--errors paper.");
  const Comparer comparer(settings, photo, draws, pairs);
  NeededPicture needed;
  needed.resolution = settings.resolution;
  needed.summary = settings.summary;
  const auto try_it = [&](int resolution, const std::string& summary) {
    if (progress) progress(std::to_string(resolution) + " pixels, " + summary);
    needed.tried.push_back(comparer.compare(resolution, summary));
    return needed.tried.back().agrees;
  };
  int resolution = settings.resolution;
  for (const int fewer : coarser(resolution, comparer.least_resolution(settings.summary))) {
    if (!try_it(fewer, settings.summary)) break;
    resolution = fewer;
  }
  const int levels = levels_of(*make_summary(settings.summary, settings.network));
  for (int fewer = levels - 1; fewer > 0; --fewer)
    if (!try_it(resolution, with_levels(settings.summary, fewer))) break;
  return needed;
}

}  // namespace patina
