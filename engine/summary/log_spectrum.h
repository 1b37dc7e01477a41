#pragma once

#include "engine/summary/summary.h"
#include "engine/summary/weight_cache.h"

namespace patina {

/// Where bands of frequencies 1 ... nyquist (cycles per side) begin: bands + 1 whole numbers from 1 to
/// nyquist + 1, each above the one before, in equal ratios as far as whole numbers allow.
/// @param nyquist  at least bands
std::vector<int> band_edges(int nyquist, int bands);

/// The power of a photo's rounding to 8 bits, 1 / (12 255^2): what is weaker is not in the photo, and keeps
/// the logarithm of a constant image finite.
constexpr double kRoundingPower = 1.0 / (12 * 255.0 * 255.0);

/// Natural logarithm of the luminance's power in concentric rings of frequency: how coarse and how strong an
/// isotropic texture is (paper section 4, "Fourier transforms of image bins"). Power is |FFT|^2 / pixels,
/// averaged over a ring; white noise of variance v has power v in every ring. Mean brightness (frequency 0)
/// is left out; the last ring takes the corners beyond the Nyquist frequency.
class RingSpectrum final : public Summary {
 public:
  explicit RingSpectrum(int rings);

  at::Tensor of(const at::Tensor& images) const override;  ///< [k, rings], from coarse to fine
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return 2 * rings_; }

 private:
  int rings_;
  WeightCache weights_;  ///< [n * (n / 2 + 1), rings], each column sums to 1
};

/// The same of the image's columns, one by one, their power averaged over all columns: the streaks of a
/// surface brushed sideways, whatever their phase (the paper's 1-D FFTs of vertical bins).
class ColumnSpectrum final : public Summary {
 public:
  explicit ColumnSpectrum(int bands);

  at::Tensor of(const at::Tensor& images) const override;  ///< [k, bands], from coarse to fine
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return 2 * bands_; }

 private:
  int bands_;
  WeightCache weights_;  ///< [n / 2 + 1, bands], each column sums to 1
};

}  // namespace patina
