#pragma once

#include "engine/image.h"
#include "engine/run/alarm.h"

namespace patina {

/// What a photo alone says against a match that is to come:
///   "dark"        nearly all of it is black
///   "burnt out"   much of it is at its brightest, where differences are lost
///   "clipped"     much of a channel is cut off below white: it was burnt out and darkened afterwards
///   "blank"       neither texture nor highlight: every pixel is the same
///   "off centre"  it is brightest off the middle: the flash was not beside the camera, or the crop is not
///                 around its highlight
/// @param photo  square, 3 channels, sRGB in [0,1]
Alarms photo_alarms(const Image& photo);

}  // namespace patina
