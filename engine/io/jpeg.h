#pragma once

#include "engine/image.h"

namespace patina {

/// What is left of an image that is stored as a JPEG and read again, in memory: values of 8 bits, colours of
/// half the resolution.
/// @param image    3 channels, display values in [0,1]
/// @param quality  1 to 100
Image through_jpeg(const Image& image, int quality);

}  // namespace patina
