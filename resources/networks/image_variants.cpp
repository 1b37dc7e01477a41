#include "resources/networks/image_variants.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/reflection_pad2d.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/upsample_bilinear2d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace patina {
namespace {

double between(double low, double high, Rng& rng) { return low + (high - low) * rng.uniform(); }

at::Tensor to_side(const at::Tensor& image, std::int64_t side) {
  return at::upsample_bilinear2d(image.unsqueeze(0), {side, side}, /*align_corners=*/false).squeeze(0);
}

at::Tensor box_mean(const at::Tensor& image, std::int64_t radius) {
  const at::Tensor padded = at::reflection_pad2d(image.unsqueeze(0), {radius, radius, radius, radius});
  return at::avg_pool2d(padded, {2 * radius + 1, 2 * radius + 1}, {1, 1}).squeeze(0);
}

at::Tensor colour(const std::array<double, 3>& rgb) {
  return at::tensor({rgb[0], rgb[1], rgb[2]}, at::kFloat).view({3, 1, 1});
}

using Variant = at::Tensor (*)(const at::Tensor& image, const at::Tensor& other, Rng& rng);

at::Tensor blurred(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const double share = between(0.3, 1, rng);
  return (1 - share) * image + share * box_mean(image, 1 + rng.below(2));
}

at::Tensor toned(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const double exponent = std::exp(0.4 * rng.normal());
  return image.clamp_min(1e-4).pow(exponent) * between(0.5, 1.3, rng);
}

at::Tensor tinted(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const auto gain = [&] { return std::exp(0.25 * rng.normal()); };
  return image * colour({gain(), gain(), gain()});
}

at::Tensor cropped(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const std::int64_t side = image.size(1);
  const auto kept = static_cast<std::int64_t>(static_cast<double>(side) * between(0.45, 0.95, rng));
  const int room = static_cast<int>(side - kept) + 1;
  const std::int64_t top = rng.below(room), left = rng.below(room);
  return to_side(image.slice(1, top, top + kept).slice(2, left, left + kept), side);
}

at::Tensor of_other_contrast(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const at::Tensor mean = image.mean({1, 2}, /*keepdim=*/true);
  return mean + between(0.3, 1.6, rng) * (image - mean);
}

at::Tensor noisy(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const std::int64_t side = image.size(1), grain = std::int64_t{1} << rng.below(3);
  std::vector<float> values(static_cast<std::size_t>((side / grain) * (side / grain)));
  const double sd = between(0.01, 0.08, rng);
  for (float& value : values) value = static_cast<float>(sd * rng.normal());
  return image + to_side(at::tensor(values, at::kFloat).view({1, side / grain, side / grain}), side);
}

at::Tensor turned(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  at::Tensor result = image.rot90(rng.below(4), {1, 2});
  return rng.below(2) == 0 ? result : result.flip(2);
}

at::Tensor evenly_lit(const at::Tensor& image, const at::Tensor&, Rng& rng) {
  const at::Tensor light = box_mean(image, image.size(1) / 8).clamp_min(0.02);
  return image * (image.mean({1, 2}, /*keepdim=*/true) / light).pow(between(0.3, 1, rng));
}

at::Tensor mixed(const at::Tensor& image, const at::Tensor& other, Rng& rng) {
  const double share = between(0.1, 0.6, rng);
  if (rng.below(2) == 0) return (1 - share) * image + share * other;
  const at::Tensor texture = other.mean(0, /*keepdim=*/true);
  return image * (texture / texture.mean().clamp_min(0.02)).pow(share);
}

constexpr std::array<Variant, 9> kVariants{blurred, toned,  tinted,     cropped, of_other_contrast,
                                           noisy,   turned, evenly_lit, mixed};

}  // namespace

at::Tensor vary(const at::Tensor& image, const at::Tensor& other, Rng& rng) {
  const Variant variant = kVariants[static_cast<std::size_t>(rng.below(kVariants.size()))];
  return variant(image, other, rng).clamp(0, 1).contiguous();
}

at::Tensor mottled(const at::Tensor& image, Rng& rng) {
  const std::int64_t patches = std::int64_t{4} << rng.below(5);
  const double sd = between(0.05, 0.3, rng);
  std::vector<float> logarithms(static_cast<std::size_t>(patches * patches));
  for (float& logarithm : logarithms) logarithm = static_cast<float>(sd * rng.normal());
  const at::Tensor field = at::tensor(logarithms, at::kFloat).view({1, patches, patches}).exp();
  return (image * to_side(field, image.size(1))).clamp(0, 1);
}

at::Tensor sharpened(const at::Tensor& image, Rng& rng) {
  return (image + between(0.2, 1.2, rng) * (image - box_mean(image, 1))).clamp(0, 1);
}

}  // namespace patina
