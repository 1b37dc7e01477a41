#pragma once

#include "engine/image.h"

namespace patina {

// What goes wrong between a surface and its photo. All take and return sRGB in [0,1], square, 3 channels,
// rounded to 8 bits as a file would be.

Image exposed(const Image& photo, double r, double g, double b);  ///< linear light times these, clipped
Image blurred(const Image& photo, double sd);                     ///< by a Gaussian of so many pixels
Image sharpened(const Image& photo, double sd, double amount);    ///< unsharp mask
Image downscaled(const Image& photo, int side);                   ///< and up again
/// The middle of a wider photo, so many pixels a side, turned about its horizontal axis and seen from 1.2
/// sides away.
Image tilted(const Image& wide, double degrees, int side);
Image cropped(const Image& photo, int x, int y, int side);
Image grey(int side, float level);

}  // namespace patina
