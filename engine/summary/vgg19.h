#pragma once

#include <string>

#include "engine/summary/tensor_index.h"

namespace patina {

/// Whether a file holds a VGG by the names that torchvision and timm give its convolutions,
/// "features.0.weight".
bool looks_like_vgg(const TensorIndex& index);

/// The description (engine/summary/network.h) of VGG-19's convolutions for summaries (Simonyan and Zisserman
/// 2015, configuration E; Gatys et al. 2015): a tap before each of the five poolings, average instead of
/// maximum pooling, reflection padding, ImageNet's normalisation. The classifier is not part of it.
/// @throws UserError if one of the 16 convolutions is missing or has another shape
std::string describe_vgg19(const std::filesystem::path& file, const TensorIndex& index);

}  // namespace patina
