#pragma once

#include <string>
#include <vector>

#include "gui/session.h"

namespace patina {

/// Whether the draws leave a parameter where it was assumed to be before looking: the photo says nothing of
/// it.
bool not_pinned_down(const QuantitySummary& quantity);

/// What the draws of the open run advise for the next one: of the parameters that it would infer, those about
/// which there is something to say. None for another material than the run's.
std::vector<ParameterAdvice> advice_for_next_run(const Session& session);

/// What there is to say of one parameter, in a few words: "Bump height is not pinned down".
std::string advice_title(const ParameterAdvice& advice);

/// The same with its figure and what to do about it, for someone who knows no posteriors.
std::string advice_sentence(const ParameterAdvice& advice);

/// The parameters that need not be inferred, in a few words: "The photo leaves open: Bump height, Roughness".
/// Empty: there are none.
std::string holdable_text(const std::vector<ParameterAdvice>& advice);

}  // namespace patina
