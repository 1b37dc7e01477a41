#pragma once

#include <cstdint>
#include <vector>

#include "engine/summary/safetensors.h"

namespace patina::naive {

/// Feature maps as plain loops in double see them: the second route to every answer of the tests.
struct Maps {
  std::int64_t channels = 0, height = 0, width = 0;
  std::vector<double> values;  ///< [channels, height, width]
  double at(std::int64_t c, std::int64_t row, std::int64_t column) const {
    return values[static_cast<std::size_t>((c * height + row) * width + column)];
  }
};

Maps from_tensor(const at::Tensor& tensor);  ///< [c, h, w]
Maps normalised(const Maps& image, const double (&mean)[3], const double (&std)[3]);

/// @param reflect  padding by reflection, else with zeros
Maps convolved(const Maps& in, const SafeTensors& network, const std::string& name, bool relu,
               bool reflect = true);
Maps average_pooled(const Maps& in);
Maps max_pooled(const Maps& in);

/// mean over pixels of F_i F_j, all c * c of them, row by row
std::vector<double> gram(const Maps& features);

}  // namespace patina::naive
