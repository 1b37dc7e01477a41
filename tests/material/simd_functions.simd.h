// Read once for each target by each_target.h.
namespace patina::testing::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;

template <class F>
void over_lanes(const std::vector<float>& x, std::vector<float>& to, const F& f) {
  const std::ptrdiff_t end = std::ssize(x);
  for (std::ptrdiff_t i = 0; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    f(simd::load(x.data() + i, count), to.data() + i, count);
  }
}

void exp2_of(const std::vector<float>& x, std::vector<float>& to) {
  over_lanes(x, to,
             [](const simd::Lanes& some, float* at, int count) { simd::store(simd::exp2(some), at, count); });
}

void log2_of(const std::vector<float>& x, std::vector<float>& to) {
  over_lanes(x, to,
             [](const simd::Lanes& some, float* at, int count) { simd::store(simd::log2(some), at, count); });
}

void pow_of(const std::vector<float>& x, float exponent, std::vector<float>& to) {
  over_lanes(x, to, [exponent](const simd::Lanes& some, float* at, int count) {
    simd::store(simd::pow(some, exponent), at, count);
  });
}

void clamp_of(const std::vector<float>& x, float low, float high, std::vector<float>& to) {
  over_lanes(x, to, [low, high](const simd::Lanes& some, float* at, int count) {
    simd::store(simd::clamp(some, low, high), at, count);
  });
}

}  // namespace patina::testing::PATINA_TARGET
