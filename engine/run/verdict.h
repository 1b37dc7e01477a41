#pragma once

#include <string>

#include "engine/run/summarize.h"

namespace patina {

/// What a run must reach before its intervals are quoted: Vehtari et al. 2021, section 4.
constexpr double kGoodRhat = 1.01;
constexpr double kGoodEss = 400;
constexpr double kNotIdentified = 0.9;  ///< posterior sd over prior sd, above which a photo pins nothing down

/// Whether every identified parameter has reached kGoodRhat and kGoodEss in bulk and tail, in one sentence;
/// if not, which one is furthest from it, which chain stands apart, and along which direction the chains
/// disagree most. Parameters that the photo does not pin down and chains that never moved are left out.
/// What else speaks against the draws say RunSummary::alarms.
std::string verdict(const RunSummary& summary);

/// Whether it is so.
bool chains_agree(const RunSummary& summary);

/// Whether a quantity is evidence: it moved, and the photo pins it down (or it has no prior to compare with).
/// One that is spread over its prior because every chain sits elsewhere is evidence, too.
bool is_judged(const QuantitySummary& quantity);

/// The quantity that is furthest from good, null if there is none to judge.
const QuantitySummary* furthest_from_good(const RunSummary& summary);

}  // namespace patina
