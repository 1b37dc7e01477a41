#pragma once

#include <string>
#include <vector>

namespace at {
class Tensor;
}

namespace patina {

struct SummaryBlock;

/// How far a part of a render's summary is from the photo's.
struct BlockMisfit {
  std::string name;  ///< of the summary's block: "gram 2"
  bool is_colour = false;
  /// Of colours the root mean square difference in display units; of others relative to the photo's: of Gram
  /// matrices the Frobenius distance, of spectra the root mean square logarithm.
  double distance = 0;
  double in_errors = 0;  ///< over what the error model takes for the model's own error: 1 is as expected
};

/// Of each block of a summary.
/// @param residual  (render - photo) * inverse_sigmas(), [sum of block sizes]
std::vector<BlockMisfit> block_misfits(const at::Tensor& residual, const std::vector<SummaryBlock>& blocks,
                                       double relative_sigma, double absolute_sigma);

}  // namespace patina
