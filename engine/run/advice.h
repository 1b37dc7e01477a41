#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/draw.h"

namespace patina {

/// What a photo says about one continuous parameter, and whether the model does as well without it.
struct ParameterAdvice {
  std::string name;
  double sd_over_prior_sd = 0;
  bool identified = false;  ///< the photo narrowed it: that is at most kNotIdentified
  /// The other parameter that it trades against, if the photo tells hardly more than a combination of the
  /// two.
  std::string redundant_with;
  double correlation = 0;  ///< with that one, in sampling coordinates

  /// Of a component that can be absent (off_values()): how many times likelier its absence is after the photo
  /// than before (Savage-Dickey), with its Monte Carlo standard error.
  struct Off {
    double value = 0, ratio = 0, error = 0;
    bool operator==(const Off&) const = default;
  };
  std::optional<Off> off;

  std::optional<double> freeze_at;  ///< held there, the others' posterior stays what it is
  std::string sentence;             ///< for the user; empty where there is nothing to say
};

constexpr double kUnneeded = 3;  ///< an absence that is so many times likelier is believed
// What holding parameters may do to the others' posteriors: move a mean by so many of its sds, narrow an sd
// by such a share. Below that, they are unchanged within the Monte Carlo error of a run of 400 effective
// draws.
constexpr double kMostShift = 0.1;
constexpr double kMostNarrowing = 0.05;

/// @param draws  after warm-up at least; parameters that were held already have no advice
/// @param off    of off_values()
/// @return       in the table's order; without those that have too few effective draws to say anything
std::vector<ParameterAdvice> advise(const ParameterTable& table, const std::vector<Draw>& draws,
                                    const std::map<std::string, double>& off);

/// The parameters that can be held, and where.
std::map<std::string, double> frozen_by(const std::vector<ParameterAdvice>& advice);

}  // namespace patina
