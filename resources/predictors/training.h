#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <functional>

#include "resources/predictors/dense_student.h"

namespace patina {

struct DenseTrainingSettings {
  int epochs = 60, batch = 200;
  double rate = 1e-3;   ///< the highest, of AdamW; falls as a cosine to nothing
  double decay = 0.02;  ///< of weights
  double noise = 0.2;   ///< added to features, in their sds
  std::uint64_t seed = 1;
};

struct DenseTrainingReport {
  int epoch = 0;
  double loss = 0, held_back = 0;
  bool best = false;  ///< so far, on what was held back
};

/// Minimises a mean loss over the first examples; the last `held_back` say how good that is.
/// @param features  [n, inputs], not standardised
/// @param loss      of outputs [m, outputs] for the examples whose indices are given, [m]
/// @param report    called after each epoch, with the student as it is
void train(DenseStudent& student, const at::Tensor& features, std::int64_t held_back,
           const std::function<at::Tensor(const at::Tensor& outputs, const at::Tensor& indices)>& loss,
           const DenseTrainingSettings& settings,
           const std::function<void(const DenseTrainingReport&)>& report);

}  // namespace patina
