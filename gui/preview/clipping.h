#pragma once

#include "engine/image.h"

namespace patina {

/// A picture to lay over a photo: striped where a channel is as bright as the file can tell, transparent
/// elsewhere. @param photo  3 channels, display values
Image clipped_overlay(const Image& photo);

/// The share of an overlay's pixels that it covers.
double covered_share(const Image& overlay);

}  // namespace patina
