#pragma once

#include <string>
#include <vector>

namespace patina {

/// What a network's convolutions multiply in. Their sums, what lies between two of them, and all that is made
/// of features are float32 in either; log densities are double.
enum class Precision { float32, bfloat16 };

/// "float32", "bfloat16"
std::vector<std::string> precision_names();

/// @throws UserError for another name
Precision precision_named(const std::string& name);

/// Whether this processor convolves in bfloat16, and takes at most three quarters of float32's time for it:
/// those with such instructions (avx512_bf16, amx) take a fifth, others more, or fail. Tried once, for some
/// milliseconds.
bool bfloat16_pays();

}  // namespace patina
