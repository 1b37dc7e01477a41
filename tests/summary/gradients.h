#pragma once

#include "engine/summary/summary.h"

namespace patina {

/// Clipped noise around mid grey, [3, side, side], the same for the same seed.
at::Tensor random_image(std::int64_t side, unsigned seed = 3);

/// Of a random linear functional of a summary of random_image(side): |its derivatives along eight directions
/// by autograd - by central differences|, relative to the latter.
double gradient_error(const Summary& summary, std::int64_t side, double step);

}  // namespace patina
