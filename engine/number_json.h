#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace patina {

/// A number as JSON has it: null where it is not finite.
inline nlohmann::ordered_json number_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace patina
