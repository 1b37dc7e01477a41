#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <vector>

#include "engine/summary/network.h"

namespace patina {

/// Images, and how far a network to learn from (the teacher) puts them from each other.
struct TrainingSet {
  at::Tensor images;     ///< [count, 3, n, n] uint8, sRGB
  at::Tensor distances;  ///< [taps, count, count] float32: relative Gram distances (gram_distance.h) by tap
};

/// @param images  each [3, n, n] float32, sRGB in [0,1]; rounded to 8 bits, as photos are
TrainingSet make_training_set(const std::vector<at::Tensor>& images, const Network& teacher);

/// @throws c10::Error if the file cannot be written, or is not a training set's
void save(const TrainingSet& set, const std::filesystem::path& file);
TrainingSet load_training_set(const std::filesystem::path& file);

/// Images as a network takes them. @param bytes  uint8   @return float32 in [0,1], same shape
at::Tensor to_unit(const at::Tensor& bytes);

/// Relative distances of all pairs of rows: |a - b| / (|a| / 2 + |b| / 2).
/// @param rows  [count, size]   @return [count, count], of the same type
at::Tensor relative_distances(const at::Tensor& rows);

}  // namespace patina
