#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// Images by which a network is judged, and what each shows.
struct LabelledImages {
  std::vector<at::Tensor> images;      ///< each [3, n, n] float32, sRGB in [0,1]
  std::vector<std::string> materials;  ///< of each: "leather"

  void add(const at::Tensor& image, const std::string& material);
};

/// Renders of prior draws of every material, none of which a network was trained on (training_images.h takes
/// other irregularities).
/// @param first  draw k of a material comes from seed first + k and shows irregularities first + k + 1
LabelledImages held_out_renders(int draws_per_material, int side, std::uint64_t first = 0);

using Pair = std::pair<std::size_t, std::size_t>;

/// Pairs of images, drawn without repetition: half of them of one material, as the candidates of a fit are,
/// the others of any two images.
/// @param count  fewer are drawn if there are not as many
std::vector<Pair> held_out_pairs(const std::vector<std::string>& materials, std::size_t count,
                                 std::uint64_t seed);

/// Standard error of a statistic of pairs by the bootstrap over images: images are drawn with replacement,
/// and a pair counts as often as both of its images together. Pairs that share an image are not independent.
/// @param statistic  of the given pairs, by index, repetitions included; NaN where it is not defined
double bootstrap_error(const std::vector<Pair>& pairs, std::size_t images,
                       const std::function<double(const std::vector<std::size_t>&)>& statistic);

}  // namespace patina
