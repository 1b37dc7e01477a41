#pragma once

#include "engine/summary/safetensors.h"

namespace patina {

/// The bundled network, made from formulae alone; nothing in it is random or trained. Each of its five
/// levels, half the size of the one before, has a tap of
///   colour       +-(2 rgb - 1) and two opponent colours of both signs                       10 channels
///   texture      the rectified derivatives of luminance at this scale, of both signs          10
///   arrangement  the texture channels of the two finer levels, averaged down to this one      0 to 20
/// so that its Gram matrices hold how strong texture is at a scale, how it goes with colour, and where finer
/// texture sits in coarser. Derivatives have zero mean: brightness does not drown them. Two first and three
/// second derivatives span those of every direction (Freeman and Adelson 1991).
/// README.md beside this file says how the design was chosen and what it scores.
/// @return weights and description, as Network::load() reads them once written
SafeTensors bundled_design();

}  // namespace patina
