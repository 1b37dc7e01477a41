#pragma once

#include <array>

namespace patina {

/// The three planes of an image or of a field of vectors, as loops over pixels take them.
using Planes = std::array<float*, 3>;
using ConstPlanes = std::array<const float*, 3>;

}  // namespace patina
