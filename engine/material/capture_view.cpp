#include "engine/material/capture_view.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/full_like.h>
#include <ATen/ops/stack.h>
#include <c10/core/InferenceMode.h>

#include <map>
#include <mutex>
#include <tuple>

namespace patina {
namespace {

// A run and its previews use a handful of sizes; large ones are for export, once.
constexpr std::size_t kMostKept = 8;
constexpr int kLargestKeptView = 1024;

CaptureView make_view(const Capture& capture, int n, at::ScalarType type) {
  // A tensor born in inference mode could never serve a gradient.
  const c10::InferenceMode normal_mode(false);
  const at::Tensor step = (((at::arange(n, at::kDouble) + 0.5) / n - 0.5) * capture.size_cm).to(type);
  const at::Tensor x = step.view({1, n}).expand({n, n});
  const at::Tensor y = -step.view({n, 1}).expand({n, n});
  const at::Tensor square_radius = x.square() + y.square();
  const at::Tensor square_distance = square_radius + capture.camera_cm * capture.camera_cm;
  const at::Tensor z = at::full_like(square_radius, capture.camera_cm);
  return {.direction = at::stack({-x, -y, z}) / square_distance.sqrt(),
          .inverse_square_distance = square_distance.reciprocal(),
          .square_radius = square_radius,
          .inverse_distance = square_distance.rsqrt(),
          .offset = step,
          .camera_cm = capture.camera_cm};
}

}  // namespace

CaptureView capture_view(const Capture& capture, int resolution, at::ScalarType type) {
  if (resolution > kLargestKeptView) return make_view(capture, resolution, type);
  static std::mutex mutex;
  static std::map<std::tuple<double, double, int, at::ScalarType>, CaptureView> kept;
  const auto key = std::make_tuple(capture.size_cm, capture.camera_cm, resolution, type);
  const std::lock_guard lock(mutex);
  const auto found = kept.find(key);
  if (found != kept.end()) return found->second;
  if (kept.size() >= kMostKept) kept.clear();
  return kept.emplace(key, make_view(capture, resolution, type)).first->second;
}

}  // namespace patina
