// Read once for each target by each_target.h.
namespace patina::camera::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

// IEC 61966-2-1.
constexpr float kOffset = 0.055f, kGain = 1.055f, kGamma = 2.4f, kSlope = 12.92f;
constexpr float kLastLinearDisplay = 0.04045f, kLastLinear = 0.0031308f;

PATINA_INLINE Lanes to_linear(const Lanes& display) {
  const Lanes power = simd::pow((display + kOffset) * (1 / kGain), kGamma);
  return display <= kLastLinearDisplay ? display * (1 / kSlope) : power;
}

PATINA_INLINE Lanes to_display(const Lanes& linear) {
  const Lanes positive = simd::max(kLastLinear - Lanes{}, linear);
  const Lanes power = kGain * simd::pow(positive, 1 / kGamma) - kOffset;
  return linear <= kLastLinear ? linear * kSlope : power;
}

}  // namespace

void expose(float* pixels, const float* normals, std::ptrdiff_t count, float white, float dark_variance) {
  for (std::ptrdiff_t i = 0; i < count; i += simd::kLanes) {
    const int some = simd::lanes_from(i, count);
    const Lanes electrons = white * to_linear(simd::clamp(simd::load(pixels + i, some), 0, 1));
    const Lanes counted = electrons + simd::sqrt(electrons + dark_variance) * simd::load(normals + i, some);
    simd::store(to_display(simd::clamp(counted * (1 / white), 0, 1)), pixels + i, some);
  }
}

}  // namespace patina::camera::PATINA_TARGET
