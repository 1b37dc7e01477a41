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

/// Calls f(i, count) for kLanes of begin ... end - 1 after kLanes; their count is known to the compiler in
/// all but the last.
template <class F>
PATINA_INLINE void over(std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  std::ptrdiff_t i = begin;
  for (; i + kLanes <= end; i += kLanes) f(i, kLanes);
  if (i < end) f(i, static_cast<int>(end - i));
}

/// @param index  Bits, or a pointer to kLanes of them
template <class Index>
PATINA_INLINE Lanes gather(const float* from, const Index& index) {
  Lanes lanes;
  for (int k = 0; k < kLanes; ++k) lanes[k] = from[index[k]];
  return lanes;
}

/// How far apart the entries of a table may lie that take() finds without asking memory for each.
constexpr int kWindow = 3 * kLanes;

/// Which kLanes entries of a table are wanted, each with the one behind it: counted from one of them, and how
/// far from there all lie, as those of neighbouring pixels mostly do.
struct Places {
  enum class Within : std::uint8_t { lanes, window, table };
  std::ptrdiff_t from;
  Bits index;
  Within within;
};

PATINA_INLINE bool any_at_least(const Bits& index, int bound) {
#if PATINA_LANES == 16
  return __builtin_ia32_ucmpd512_mask(index, bound - Bits{}, 5, -1) != 0;
#else
  typedef std::uint32_t Counts __attribute__((vector_size(sizeof(Bits))));
  Counts counts;
  std::memcpy(&counts, &index, sizeof counts);
  const Bits above = counts >= static_cast<std::uint32_t>(bound);
  std::int64_t parts[kLanes / 2], all = 0;
  std::memcpy(parts, &above, sizeof parts);
  for (const std::int64_t part : parts) all |= part;
  return all != 0;
#endif
}

/// @param at  entries of a table but its last   @param size  how many it has
PATINA_INLINE Places places_of(const Bits& at, std::ptrdiff_t size) {
  const std::ptrdiff_t first = at[0] < at[kLanes - 1] ? at[0] : at[kLanes - 1], last = size - kWindow;
  const std::ptrdiff_t from = first < last ? first : last;
  const Bits index = at - static_cast<std::int32_t>(from);
  if (from < 0 || any_at_least(index, kWindow - 1)) return {0, at, Places::Within::table};
  return {from, index, any_at_least(index, kLanes - 1) ? Places::Within::window : Places::Within::lanes};
}

/// Entries of a table, and those behind them.
struct Neighbours {
  Lanes here, next;
};

/// Those at these places, by shuffles where the processor has them.
PATINA_INLINE Neighbours take(const float* table, const Places& places) {
  const float* from = table + places.from;
  const Bits& index = places.index;
#if PATINA_LANES > 4
  const auto lanes_at = [&](int i) __attribute__((always_inline)) {
    Lanes lanes;
    std::memcpy(&lanes, from + i, sizeof lanes);
    return lanes;
  };
  if (places.within == Places::Within::lanes) {
    const Lanes all = lanes_at(0);
    return {__builtin_shuffle(all, index), __builtin_shuffle(all, index + 1)};
  }
  if (places.within == Places::Within::window) {
    const Lanes first = lanes_at(0), second = lanes_at(kLanes), third = lanes_at(2 * kLanes);
    const auto pick = [&](const Bits& i) __attribute__((always_inline)) {
      return i < 2 * kLanes ? __builtin_shuffle(first, second, i) : __builtin_shuffle(third, i);
    };
    return {pick(index), pick(index + 1)};
  }
#endif
  return {gather(from, index), gather(from + 1, index)};
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
  if (count == kLanes) {  // as one load: of a length known at run time it is made of many
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
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

// The processor's own instruction, for which gcc has a comparison and a choice.
#if PATINA_LANES == 16
#define PATINA_EXTREME(name, x, y) __builtin_ia32_##name##ps512_mask(x, y, x, 0xffff, 4)
#elif PATINA_LANES == 8
#define PATINA_EXTREME(name, x, y) __builtin_ia32_##name##ps256(x, y)
#elif defined(__x86_64__)
#define PATINA_EXTREME(name, x, y) __builtin_ia32_##name##ps(x, y)
#endif

/// The larger of two numbers; y where one of them is none.
PATINA_INLINE Lanes max(const Lanes& x, const Lanes& y) {
#if defined(PATINA_EXTREME)
  return PATINA_EXTREME(max, x, y);
#else
  return x > y ? x : y;
#endif
}

/// The smaller of two numbers; y where one of them is none.
PATINA_INLINE Lanes min(const Lanes& x, const Lanes& y) {
#if defined(PATINA_EXTREME)
  return PATINA_EXTREME(min, x, y);
#else
  return x < y ? x : y;
#endif
}
#undef PATINA_EXTREME

PATINA_INLINE Lanes clamp(const Lanes& x, float low, float high) {
  return min(high - Lanes{}, max(low - Lanes{}, x));
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

/// 2^x for x in [-126, 127], relative error below 3e-7: the nearest whole power times a polynomial of the
/// rest, which is the best of its degree (as log2's is, of those without a constant).
PATINA_INLINE Lanes exp2(const Lanes& x) {
  constexpr float kRound = 12582912;  // 1.5 * 2^23: adding it leaves the nearest whole number in the low bits
  const Lanes shifted = x + kRound;
  const Lanes r = x - (shifted - kRound);
  Lanes p = r * 1.326472731e-3f + 9.671512991e-3f;
  p = p * r + 5.550733581e-2f;
  p = p * r + 2.402224243e-1f;
  p = p * r + 6.931470037e-1f;
  p = p * r + 1;
  Bits whole, bits;
  std::memcpy(&whole, &shifted, sizeof whole);
  std::memcpy(&bits, &p, sizeof bits);
  bits += whole << 23;  // to the exponent; what else is in `whole` is shifted out
  std::memcpy(&p, &bits, sizeof p);
  return p;
}

/// 2^x, or the nearest power from 2^-126 to 2^126. What is no number stays none.
PATINA_INLINE Lanes exp2_of_any(const Lanes& x) { return exp2(clamp(x, -126, 126)); }

/// log2(x) for normal positive x; error below 2e-7 of the larger of |log2 x| and 1.
PATINA_INLINE Lanes log2(const Lanes& x) {
  Bits bits;
  std::memcpy(&bits, &x, sizeof bits);
  // Mantissa in [sqrt(1/2), sqrt(2)).
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const Bits exponent = (bits - kSqrtHalf) >> 23;
  const Bits mantissa_bits = bits - (exponent << 23);
  Lanes m;
  std::memcpy(&m, &mantissa_bits, sizeof m);
  const Lanes r = m - 1, e = __builtin_convertvector(exponent, Lanes);
  Lanes p = 2.368903458e-1f - r * 1.457444578e-1f;
  p = p * r - 2.500690222e-1f;
  p = p * r + 2.867074609e-1f;
  p = p * r - 3.600872159e-1f;
  p = p * r + 4.809394479e-1f;
  p = p * r - 7.213571668e-1f;
  p = p * r + 1.442694783f;
  return p * r + e;
}

/// x^exponent for normal positive x, where exponent log2 x lies in [-126, 127]; relative error below
/// 3e-7 (1 + |exponent log2 x|).
template <class Exponent>
PATINA_INLINE Lanes pow(const Lanes& x, const Exponent& exponent) {
  return exp2(log2(x) * exponent);
}

}  // namespace patina::simd::PATINA_TARGET
