// Vectors as wide as PATINA_TARGET's, and functions of them; read once for each target by each_target.h,
// hence without a guard.
namespace patina::simd::PATINA_TARGET {

constexpr int kLanes = PATINA_LANES;
/// As many pixels at once as the processor takes; operators work entry by entry, comparisons give masks for
/// ?:. A wider vector than the processor has would be taken apart, its comparisons into single numbers.
typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef std::int32_t Bits __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

/// How many of the pixels i ... end - 1 are taken next.
PATINA_INLINE int lanes_from(std::ptrdiff_t i, std::ptrdiff_t end) {
  return static_cast<int>(end - i < kLanes ? end - i : kLanes);
}

/// @param index  Bits, or a pointer to kLanes of them
template <class Index>
PATINA_INLINE Lanes gather(const float* from, const Index& index) {
  Lanes lanes;
  for (int k = 0; k < kLanes; ++k) lanes[k] = from[index[k]];
  return lanes;
}

/// The first `count` of kLanes numbers, the last of them repeated to fill up.
PATINA_INLINE Lanes load(const float* from, int count) {
  Lanes lanes;
  if (count == kLanes) {
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
  for (int k = 0; k < kLanes; ++k) lanes[k] = from[k < count ? k : count - 1];
  return lanes;
}

PATINA_INLINE Lanes load_or_zero(const float* from, int count) {
  Lanes lanes{};
  std::memcpy(&lanes, from, static_cast<std::size_t>(count) * sizeof(float));
  return lanes;
}

PATINA_INLINE void store(const Lanes& lanes, float* to, int count) {
  if (count == kLanes) {
    std::memcpy(to, &lanes, sizeof lanes);
    return;
  }
  for (int k = 0; k < count; ++k) to[k] = lanes[k];
}

PATINA_INLINE void add(const Lanes& lanes, float* to, int count) {
  store(load(to, count) + lanes, to, count);
}

PATINA_INLINE double sum(const Lanes& lanes) {
  double total = 0;
  for (int k = 0; k < kLanes; ++k) total += static_cast<double>(lanes[k]);
  return total;
}

PATINA_INLINE Lanes clamp(const Lanes& x, float low, float high) {
  const Lanes raised = x < low ? low - Lanes{} : x;
  return raised > high ? high - Lanes{} : raised;
}

/// The largest whole number not above x, of 31 bits.
PATINA_INLINE Lanes floor(const Lanes& x) {
  const Lanes whole = __builtin_convertvector(__builtin_convertvector(x, Bits), Lanes);
  return whole > x ? whole - 1 : whole;
}

PATINA_INLINE Lanes sqrt(const Lanes& x) {
  Lanes root;
  for (int k = 0; k < kLanes; ++k) root[k] = __builtin_sqrtf(x[k]);
  return root;
}

/// exp(x) for x in [-87, 88], clamped to it; relative error below 3e-7. Cody and Waite's reduction and the
/// polynomial of Moshier's Cephes library (expf).
PATINA_INLINE Lanes exp(const Lanes& exponent) {
  const Lanes x = clamp(exponent, -87, 88);
  constexpr float kRound = 12582912;  // 1.5 * 2^23: adding it leaves the nearest whole number in the low bits
  const Lanes shifted = x * 1.44269504088896341f + kRound;
  const Lanes whole = shifted - kRound;
  const Lanes r = x - whole * 0.693359375f + whole * 2.12194440e-4f;
  Lanes p = r * 1.9875691500e-4f + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  p = p * r * r + r + 1;
  const Bits power = __builtin_convertvector(whole, Bits) + 127;
  const Bits bits = power << 23;
  Lanes scale;
  std::memcpy(&scale, &bits, sizeof scale);
  return p * scale;
}

/// log(x) for normal positive x; error below 2e-7 of the larger of |log x| and 1. Polynomial of Cephes
/// (logf).
PATINA_INLINE Lanes log(const Lanes& x) {
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  // Mantissa in [sqrt(1/2), sqrt(2)).
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const Bits exponent = (bits - kSqrtHalf) >> 23;
  const Bits mantissa_bits = bits - (exponent << 23);
  Lanes m;
  std::memcpy(&m, &mantissa_bits, sizeof m);
  const Lanes r = m - 1, e = __builtin_convertvector(exponent, Lanes), r2 = r * r;
  Lanes p = r * 7.0376836292e-2f - 1.1514610310e-1f;
  p = p * r + 1.1676998740e-1f;
  p = p * r - 1.2420140846e-1f;
  p = p * r + 1.4249322787e-1f;
  p = p * r - 1.6668057665e-1f;
  p = p * r + 2.0000714765e-1f;
  p = p * r - 2.4999993993e-1f;
  p = p * r + 3.3333331174e-1f;
  p = p * r * r2 - e * 2.12194440e-4f - 0.5f * r2;
  return r + p + e * 0.693359375f;
}

}  // namespace patina::simd::PATINA_TARGET
