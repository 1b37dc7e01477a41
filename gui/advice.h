#pragma once

#include <optional>
#include <string>

#include "gui/session.h"

namespace patina {

/// Whether the draws leave a parameter where it was assumed to be before looking: the photo says nothing of
/// it.
bool not_pinned_down(const QuantitySummary& quantity);

/// A parameter that need not be inferred, and where its draws lie on average.
struct LooseParameter {
  std::string name;
  double value = 0;
};

/// The parameter, of those that the next run would infer, that the run's photo pins down least, once there
/// are enough draws to say so; none where it pins all down.
std::optional<LooseParameter> loosest(const Session& session);

}  // namespace patina
