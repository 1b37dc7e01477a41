#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace patina {

/// Photos of draws from a material's prior: what a predictor sees, and what it is to tell.
struct PhotoExamples {
  at::Tensor features;     ///< [n, PhotoFeatures::size()] float32, or StructureFeatures::size()
  at::Tensor coordinates;  ///< [n, p] float32, in which the prior is N(0, I)
  at::Tensor levels;       ///< [n, choices] int64
};

/// Each photo has a sample's side of 4 to 60 cm and a camera of its own, irregularities from a pool of
/// sixteen (of which a material's places show it ever another piece), and pixels that are means over their
/// area, with a sensor's noise, 8 bits and a JPEG's losses (photographed()), little of either to much.
/// @param varied   what a chooser sees: each changed at random as a photo differs from a render
///                 (image_variants.h) and with even noise; pixels of every second one are points; features
///                 are of structure alone
/// @param seed     of everything; the pool's too, so that no two seeds share irregularities
/// @param threads  the photos do not depend on it
PhotoExamples simulate_photos(const std::string& material, int count, std::uint64_t seed, int threads,
                              bool varied = false);

void save(const PhotoExamples& photos, const std::filesystem::path& file);
PhotoExamples load_photo_examples(const std::filesystem::path& file);

}  // namespace patina
