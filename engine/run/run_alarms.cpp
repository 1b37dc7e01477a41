#include "engine/run/run_alarms.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/format.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/photo_alarms.h"
#include "engine/run/threads.h"
#include "engine/sampling/noise.h"

namespace patina {

Alarms run_alarms(const Image& photo, const Posterior& posterior, const Position& best, const Image& finer,
                  const std::map<std::string, double>& fixed, const std::optional<PhotoFit>& fit) {
  Alarms alarms = photo_alarms(photo);
  const double noise =
      value_noise(posterior, best, kNoiseRepeats, hardware_threads(), [] { use_tensor_threads(1); });
  if (const auto alarm = noise_alarm(noise)) alarms.push_back(*alarm);
  const std::vector<BlockMisfit> misfits = posterior.misfit(best);
  const bool by_hand = !fit || fit->discrepancy > 0;
  auto far = fit ? fit_alarm(*fit, posterior.table().material) : std::nullopt;
  if (!far) far = by_hand ? misfit_alarm(misfits) : colour_alarm(misfits);
  if (far) alarms.push_back(*far);
  if (const auto alarm = strain_alarm(posterior.table(), posterior.values(best), fixed))
    alarms.push_back(*alarm);
  if (const auto alarm = coarse_alarm(posterior, best, finer)) alarms.push_back(*alarm);
  return alarms;
}

namespace {

/// The part that is furthest off, if that is too far.
std::optional<BlockMisfit> too_far(const std::vector<BlockMisfit>& misfits) {
  const auto worst = std::ranges::max_element(misfits, {}, &BlockMisfit::in_errors);
  if (worst == misfits.end() || !(worst->in_errors > kFar)) return std::nullopt;
  return *worst;
}

/// "its colours are off by 40 of 255 levels, where a good match is off by 5"
std::string how_far(const BlockMisfit& off) {
  const double good = off.distance / off.in_errors;
  if (off.is_colour)
    return format("its colours are off by %.0f of 255 levels, where a good match is off by %.0f",
                  255 * off.distance, 255 * good);
  return format("its texture (%s) is off by %.0f %%, where a good match is off by %.0f %%", off.name.c_str(),
                100 * off.distance, 100 * good);
}

}  // namespace

std::optional<Alarm> misfit_alarm(const std::vector<BlockMisfit>& misfits) {
  const std::optional<BlockMisfit> off = too_far(misfits);
  if (!off) return std::nullopt;
  return Alarm{"misfit",
               "The best match is far from the photo: " + how_far(*off) +
                   ". Intervals mean little: try another material, or check the size and the crop."};
}

std::optional<Alarm> colour_alarm(std::vector<BlockMisfit> misfits) {
  std::erase_if(misfits, [](const BlockMisfit& each) { return !each.is_colour; });
  const std::optional<BlockMisfit> off = too_far(misfits);
  if (!off) return std::nullopt;
  return Alarm{"colours", "The best match is far from the photo: " + how_far(*off) +
                              ". What simulated photos teach does not hold for this one: intervals mean "
                              "little. Errors set by hand (--errors paper) stay nearer to it."};
}

std::optional<Alarm> fit_alarm(const PhotoFit& fit, const std::string& material) {
  if (fit.widening <= 1 || fit.p > kRare) return std::nullopt;
  const std::string far = format(
      "it is %.2g times as far from simulated photos as they are from each other, and intervals were "
      "widened %.2g-fold",
      fit.distance, std::sqrt(fit.widening));
  return Alarm{"misfit", "This photo does not look like " + material +
                             " within what its irregularities explain: " + far +
                             ". Try another material, or check the size and the crop."};
}

std::optional<Alarm> strain_alarm(const ParameterTable& table, const ParameterValues& best,
                                  const std::map<std::string, double>& fixed) {
  double square = 0, furthest = 0, free = 0;
  std::string of;
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    const Parameter& parameter = table.continuous[i];
    if (fixed.contains(parameter.name)) continue;
    const double u = PriorTransform(parameter.prior).coordinate(best.continuous[i]);
    square += u * u;
    ++free;
    if (std::abs(u) < furthest) continue;
    furthest = std::abs(u);
    of = parameter.name + format(" = %.3g", best.continuous[i]);
  }
  if (free == 0 || Eigen::numext::igammac(free / 2, square / 2) > kUnlikely) return std::nullopt;
  return Alarm{"strained",
               "The best match needs parameters that the prior calls unlikely, most of all " + of +
                   ": give them a wider prior (--prior) if they can be so, or try another material."};
}

std::optional<Alarm> coarse_alarm(const Posterior& posterior, const Position& best, const Image& finer) {
  const Eigen::VectorXd seen = posterior.simulated_summaries({&finer, 1}).col(0);
  const std::vector<BlockMisfit> misfits = posterior.given(posterior.in_errors(seen)).misfit(best);
  const auto worst = std::ranges::max_element(misfits, {}, &BlockMisfit::in_errors);
  if (worst == misfits.end() || !(worst->in_errors > kCoarse)) return std::nullopt;
  return Alarm{
      "coarse",
      "The best match looks otherwise at the pixels of this run than at more of them: its highlight or its "
      "grain is too fine for them, and intervals may miss the truth. Look at more pixels (--resolution)."};
}

}  // namespace patina
