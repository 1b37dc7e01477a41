#pragma once

#include "engine/summary/safetensors.h"

namespace patina {

/// Adds a description to the weights of a VGG-19 encoder distilled to a sixteenth of its parameters (Wang et
/// al., CVPR 2020, converted to safetensors as conv0, conv11 ... conv51 and conv11_aux ... conv51_aux), so
/// that Network::load() reads them: max pooling, and taps at the first convolution of each block through its
/// auxiliary 1 x 1 convolution.
/// @throws UserError if a tensor of that network is missing
SafeTensors describe_distilled_vgg(SafeTensors weights);

}  // namespace patina
