#pragma once

#include <ATen/core/Tensor.h>

#include <utility>

namespace patina {

struct WiderErrors;

/// Makes the errors of a summary N(0, I): over the sds that are set by hand, and along directions in which
/// errors are wider over what their sds are there.
class Whitening {
 public:
  /// @param inverse_sigmas  of the hand-set errors: inverse_sigmas()
  explicit Whitening(at::Tensor inverse_sigmas) : inverse_sigmas_(std::move(inverse_sigmas)) {}

  /// Over the same hand-set sds.
  Whitening along(const WiderErrors& wider) const;

  const at::Tensor& inverse_sigmas() const { return inverse_sigmas_; }

  /// @param difference  of summaries, in their own units, [entries]; gradients flow through
  at::Tensor operator()(const at::Tensor& difference) const;
  at::Tensor undo(const at::Tensor& white) const;

 private:
  at::Tensor stretched(const at::Tensor& scaled, const at::Tensor& by) const;

  at::Tensor inverse_sigmas_;
  at::Tensor directions_;  ///< [entries, n]; undefined: none
  at::Tensor sds_;         ///< [n], along them, in units of the hand-set ones
};

}  // namespace patina
