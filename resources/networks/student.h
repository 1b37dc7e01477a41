#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <string>
#include <vector>

#include "engine/summary/safetensors.h"

namespace patina {

/// A network in training: levels, each half the size of the one before, of 3 x 3 convolutions with ReLU; the
/// last features of a level are its tap. What it computes is what Network computes from its file.
class Student {
 public:
  /// Random weights (He et al. 2015) that a batch of images then brings to a sensible range: every channel
  /// has mean 0 and variance 1 before its ReLU, so that none is born dead or always on; every other filter of
  /// the first convolution sums to 0, so that edges are seen beside colours.
  /// @param levels  channels of each convolution of each level: {{16}, {32}, {48, 48}}
  /// @param images  [b, 3, n, n] float32, sRGB in [0,1]
  Student(const std::vector<std::vector<std::int64_t>>& levels, const at::Tensor& images, std::uint64_t seed);

  /// Goes on from a file of to_file(). @throws UserError if it is not such a file
  explicit Student(const SafeTensors& file);

  /// What training changes; gradients flow to them.
  std::vector<at::Tensor> parameters() const;

  /// Gram matrices of all taps. @return for each tap [b, c c]
  std::vector<at::Tensor> grams(const at::Tensor& images) const;

  /// Gives channels that hardly any pixel of these images turns on new random weights, as large as the
  /// others' at their level; what reads them begins with 0. @return how many
  int revive(const at::Tensor& images, std::uint64_t seed);

  /// Rescales weights, which changes no relative distance: the mean norm of every tap's Gram matrix over
  /// these images becomes 1.
  void balance(const at::Tensor& images);

  /// As Network::load() reads it.
  SafeTensors to_file(const std::string& name) const;

 private:
  struct Convolution {
    at::Tensor weight;  ///< [out, in, 3, 3]
    at::Tensor bias;    ///< [out]
    at::Tensor operator()(const at::Tensor& x) const;
  };

  std::vector<std::vector<Convolution>> levels_;
};

}  // namespace patina
