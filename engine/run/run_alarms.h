#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/posterior/photo_fit.h"
#include "engine/posterior/posterior.h"
#include "engine/run/alarm.h"

namespace patina {

/// What a run can say against itself before its first draw:
///   "dark", "burnt out", "clipped", "blank", "off centre"  see photo_alarms()
///   "noise"   see noise_alarm()
///   "misfit"  see misfit_alarm(), or fit_alarm()
///   "colours"  see colour_alarm()
///   "strained"  see strain_alarm()
///   "coarse"  see coarse_alarm()
/// Takes kNoiseRepeats evaluations.
/// @param finer  the best match at more pixels than the run's
/// @param fixed  parameters that are held, by name
/// @param fit    of calibrated errors: "misfit" is then fit_alarm()'s, or, if irregularities alone explain
///               the photo, there are "colours" in its place
Alarms run_alarms(const Image& photo, const Posterior& posterior, const Position& best, const Image& finer,
                  const std::map<std::string, double>& fixed, const std::optional<PhotoFit>& fit);

constexpr int kNoiseRepeats = 20;

/// The best match is further from the photo than kFar times the error that the model is granted.
std::optional<Alarm> misfit_alarm(const std::vector<BlockMisfit>& misfits);

/// The best match's mean colours are further from the photo's than kFar times the error that the model is
/// granted. Irregularities, which make textures differ, hardly move them, but among thousands of entries that
/// say a photo is like simulated ones they are few.
std::optional<Alarm> colour_alarm(std::vector<BlockMisfit> misfits);

/// The photo is further from simulated photos, off by the hand-set errors as they are, than all but kRare
/// of them.
std::optional<Alarm> fit_alarm(const PhotoFit& fit, const std::string& material);

/// The granted errors are the average of the paper's own fits to its 14 photos; none of the nine that the
/// tests have is beyond so many times that average.
constexpr double kFar = 2.5;

/// The best match needs parameters that all together the prior has less often than kUnlikely: the conflict of
/// prior and photo (Evans & Moshonov 2006), which a misfit does not show where parameters can make up for it.
/// In coordinates in which the prior is N(0, I) the square of their distance from 0 is a chi-square.
std::optional<Alarm> strain_alarm(const ParameterTable& table, const ParameterValues& best,
                                  const std::map<std::string, double>& fixed);

constexpr double kUnlikely = 1e-3;

/// The best match looks otherwise at the run's pixels than at more of them, by more than kCoarse times the
/// error that the model is granted: a photo, whose pixels are means over their area, is then compared with a
/// highlight or grain that falls between the pixels of a render.
/// @param finer  the best match at more pixels
std::optional<Alarm> coarse_alarm(const Posterior& posterior, const Position& best, const Image& finer);

constexpr double kCoarse = 1;

}  // namespace patina
