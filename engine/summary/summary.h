#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/summary/device.h"
#include "engine/summary/precision.h"

namespace patina {

/// What the error of a block's entries is measured by; engine/posterior/error_model.h gives each its sigma.
enum class ErrorScale {
  relative,     ///< the norm of the photo's block: second moments (Gram matrices)
  logarithmic,  ///< one, the entries being logarithms of second moments (spectra)
  regional,     ///< display units: mean colours of the image's regions
};

/// A run of entries of a summary vector that share a meaning and a scale.
struct SummaryBlock {
  std::string name;  ///< "gram 2", "4 ring means"
  std::int64_t size;
  ErrorScale scale;
  /// How many blocks of the summary see the same error from different sides, as a Gram matrix and the
  /// covariances of the same features do.
  int views = 1;
};

/// A summary function (paper section 4): maps an image to a vector that forgets where things lie and keeps
/// what the material is. Safe to call from several threads.
class Summary {
 public:
  virtual ~Summary() = default;

  /// Of several images in one pass, a row each.
  /// @param images  [k, 3, n, n] float32, display (sRGB) values in [0,1]; n >= minimum_resolution()
  /// @return        [k, sum of block sizes] float32; the Euclidean norm of a relative block's part equals the
  ///                Frobenius norm of the full matrix it stands for (off-diagonal entries weighted by sqrt 2)
  virtual at::Tensor of(const at::Tensor& images) const = 0;

  /// Of one image. @param image  [3, n, n]   @return [sum of block sizes]
  at::Tensor operator()(const at::Tensor& image) const;

  virtual std::vector<SummaryBlock> blocks() const = 0;
  virtual int minimum_resolution() const = 0;
};

/// "gram"   Gram matrices of a network's features, and the mean colours of 4 concentric rings; "gram3", only
///          those of its first three levels, whatever lies behind not being loaded or run
/// "covariances"  the same less what the features' means alone make in a Gram matrix; "covariances3" too
/// "rings"  mean colours of 16 concentric rings, and the spectrum in 8 rings (isotropic, fine: flakes)
/// "bands"  mean colours of 64 upright strips, and the columns' spectrum in 16 bands (brushed metal)
/// "means"  mean colours of 4 concentric rings
std::vector<std::string> summary_names();

/// How many levels of its network a summary keeps.
int levels_of(const Summary& summary);

/// @param name     one of summary_names(), or several joined by '+' ("gram+rings"): all their blocks, in that
///                 order, those of the network together, what two of them share only once
/// @param network  a weights file; empty for the bundled one. Read only by "gram" and "covariances".
/// @param precision  of the network's convolutions
/// @param device     that the network runs on; images come from main memory and summaries go there
/// @throws UserError for an unknown name, a file that is not a network, or a device that is not at hand
std::shared_ptr<const Summary> make_summary(const std::string& name, const std::filesystem::path& network,
                                            Precision precision = Precision::float32,
                                            Device device = Device::cpu);

}  // namespace patina
