#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/parameter.h"
#include "engine/summary/safetensors.h"
#include "resources/predictors/dense_student.h"

namespace patina {

/// How many outputs the network of a Predictor (engine/prediction/predictor.h) has.
std::int64_t predictor_outputs(const ParameterTable& table);

/// Mean over photos of minus the log density that a Predictor with these outputs gives the truth, in nats.
/// @param outputs  [n, predictor_outputs()]   @param coordinates  [n, p]   @param levels  [n, choices]
at::Tensor predictor_loss(const ParameterTable& table, const at::Tensor& outputs,
                          const at::Tensor& coordinates, const at::Tensor& levels);

/// The same of the prior.
double prior_loss(const ParameterTable& table);

/// A file that Predictor::load() reads.
SafeTensors predictor_file(const ParameterTable& table, const DenseStudent& student);

}  // namespace patina
