#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// A run of entries of a summary vector that share a meaning and a scale.
struct SummaryBlock {
  std::string name;  ///< "gram 2", "ring means"
  std::int64_t size;
  bool relative;  ///< true: errors are judged relative to the block's norm (Gram matrices); false: absolute
                  ///< (means)
};

/// A summary function (paper section 4): maps an image to a vector that forgets where things lie and keeps
/// what the material is. Safe to call from several threads.
class Summary {
 public:
  virtual ~Summary() = default;

  /// @param image  [3, n, n] float32, display (sRGB) values in [0,1]; n >= minimum_resolution()
  /// @return       [sum of block sizes] float32; the Euclidean norm of a relative block's part equals the
  ///               Frobenius norm of the full matrix it stands for (off-diagonal entries weighted by sqrt 2)
  virtual at::Tensor operator()(const at::Tensor& image) const = 0;

  virtual std::vector<SummaryBlock> blocks() const = 0;
  virtual int minimum_resolution() const = 0;
};

std::vector<std::string> summary_names();

/// @param name     "gram" (Gram matrices of the network's features, plus regional means) or "means"
/// @param network  a weights file; empty for the bundled one. Unused by summaries without a network.
/// @throws UserError for an unknown name or a file that is not a network
std::shared_ptr<const Summary> make_summary(const std::string& name, const std::filesystem::path& network);

}  // namespace patina
