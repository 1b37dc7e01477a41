// Read once for each target by each_target.h.
// Formulae: models.md "Capture", as in shading.cpp, whose tensor version is the reference of the tests. Here
// each is written beside its derivative.
namespace patina::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

constexpr float kSmallestCosine = 1e-3f, kSmallestRadiance = 1e-6f;
constexpr std::size_t kMostLobes = 8;
constexpr float kInvPi = std::numbers::inv_pi_v<float>, kFourPi = 4 * std::numbers::pi_v<float>;

using Colour = std::array<Lanes, 3>;

/// The fields and the view at the pixels that are taken at once.
struct Pixels {
  std::array<Lanes, kMostFields> field;
  Colour direction;
  Lanes inverse_square_distance, square_radius;
};

/// Some of the fields, by their numbers.
struct Subset {
  std::array<std::size_t, kMostFields> fields;
  std::size_t count = 0;

  PATINA_INLINE void add(std::size_t field) { fields[count++] = field; }
  PATINA_INLINE const std::size_t* begin() const { return fields.data(); }
  PATINA_INLINE const std::size_t* end() const { return fields.data() + count; }
};

/// Sets the fields that are the same at all pixels, and returns the others.
PATINA_INLINE Subset set_uniform(const ShadingProblem& problem, Pixels& pixels) {
  Subset varying;
  for (std::size_t f = 0; f < problem.fields.size(); ++f) {
    if (problem.fields[f].uniform)
      pixels.field[f] = *problem.fields[f].data - Lanes{};
    else
      varying.add(f);
  }
  return varying;
}

PATINA_INLINE void gather(const ShadingProblem& problem, const Subset& varying, std::ptrdiff_t i, int count,
                          Pixels& pixels) {
  for (const std::size_t f : varying) pixels.field[f] = simd::load(problem.fields[f].data + i, count);
  for (std::size_t k = 0; k < 3; ++k) pixels.direction[k] = simd::load(problem.direction[k] + i, count);
  pixels.inverse_square_distance = simd::load(problem.inverse_square_distance + i, count);
  pixels.square_radius = simd::load(problem.square_radius + i, count);
}

PATINA_INLINE Lanes dot(const Pixels& pixels, std::size_t normal) {
  return pixels.field[normal] * pixels.direction[0] + pixels.field[normal + 1] * pixels.direction[1] +
         pixels.field[normal + 2] * pixels.direction[2];
}

PATINA_INLINE Lanes inside(const Lanes& x, float low, float high, const Lanes& value) {
  const Lanes above = x > low ? value : Lanes{};
  return x < high ? above : Lanes{};
}

/// Vignette times fall-off, and with the lamp's intensity.
struct Irradiance {
  Lanes per_light, value;
};

PATINA_INLINE Irradiance irradiance(const ShadingProblem& problem, const Pixels& pixels) {
  const float per_square = -0.5f / (problem.vignette_sigma * problem.vignette_sigma);
  const Lanes per_light = simd::exp(pixels.square_radius * per_square) * pixels.inverse_square_distance;
  return {per_light, per_light * problem.light};
}

/// D(c) / (4 c) and its derivatives.
struct LobeShape {
  Lanes value, by_cosine, by_roughness_x, by_roughness_y;
  Lanes by_nx, by_nz;  ///< through the tangent frame
};

/// D = alpha^2 / (pi t^2) with t = 1 - c^2 + c^2 alpha^2; all quotients from one.
PATINA_INLINE LobeShape isotropic_shape(const Lanes& c, const Lanes& roughness) {
  const Lanes square = roughness * roughness, square_alpha = square * square, square_c = c * c;
  const Lanes tail = (1 - c) * (1 + c) + square_c * square_alpha;
  const Lanes inverse = 1 / (c * tail);
  const Lanes by_alpha_before_tail = inverse * inverse * c * (1 / kFourPi);
  const Lanes value = by_alpha_before_tail * square_alpha;
  const Lanes by_tail = -2 * value * (inverse * c);
  const Lanes by_square_alpha = by_alpha_before_tail + by_tail * square_c;
  return {.value = value,
          .by_cosine = by_tail * 2 * c * (square_alpha - 1) - value * (inverse * tail),
          .by_roughness_x = by_square_alpha * 4 * square * roughness,
          .by_roughness_y = Lanes{},
          .by_nx = Lanes{},
          .by_nz = Lanes{}};
}

PATINA_INLINE LobeShape anisotropic_shape(const Pixels& pixels, const LobeFields& lobe, const Lanes& c) {
  const Lanes nx = pixels.field[lobe.normal], nz = pixels.field[lobe.normal + 2];
  const Lanes rx = pixels.field[lobe.roughness_x], ry = pixels.field[lobe.roughness_y];
  const Lanes &dx = pixels.direction[0], &dz = pixels.direction[2];
  const Lanes square_length = nx * nx + nz * nz;
  const Lanes length = simd::sqrt(square_length > 1e-8f ? square_length : 1e-8f - Lanes{});
  const Lanes hx = (nz * dx - nx * dz) / length, hy2 = 1 - hx * hx - c * c;
  const Lanes square_hy = hy2 > 0 ? hy2 : Lanes{};
  const Lanes inverse_ax = 1 / (rx * rx), inverse_ay = 1 / (ry * ry);
  const Lanes x2 = hx * hx * inverse_ax * inverse_ax, y2 = square_hy * inverse_ay * inverse_ay;
  const Lanes tail = x2 + y2 + c * c;
  const Lanes value = inverse_ax * inverse_ay / (tail * tail * c * kFourPi);
  const Lanes by_tail = -2 * value / tail;
  const Lanes hy_part = hy2 > 0 ? inverse_ay * inverse_ay : Lanes{};
  const Lanes by_hx = by_tail * 2 * hx * (inverse_ax * inverse_ax - hy_part);
  const Lanes pull = square_length > 1e-8f ? hx / square_length : Lanes{};
  return {.value = value,
          .by_cosine = by_tail * 2 * c * (1 - hy_part) - value / c,
          .by_roughness_x = (by_tail * -2 * x2 - value) * 2 / rx,
          .by_roughness_y = (by_tail * -2 * y2 - value) * 2 / ry,
          .by_nx = by_hx * (-dz / length - pull * nx),
          .by_nz = by_hx * (dx / length - pull * nz)};
}

PATINA_INLINE LobeShape shape(const Pixels& pixels, const LobeFields& lobe, const Lanes& cosine) {
  if (lobe.isotropic()) return isotropic_shape(cosine, pixels.field[lobe.roughness_x]);
  return anisotropic_shape(pixels, lobe, cosine);
}

struct CurvePower {
  float exponent, gain, offset;
};

PATINA_INLINE CurvePower power_of(DisplayCurve curve) {
  return curve == DisplayCurve::srgb ? CurvePower{1 / 2.4f, 1.055f, 0.055f} : CurvePower{1 / 2.2f, 1, 0};
}

constexpr float kSrgbLinear = 0.0031308f, kSrgbSlope = 12.92f;

PATINA_INLINE Lanes displayed(const Lanes& radiance, DisplayCurve curve) {
  const Lanes x = simd::clamp(radiance, kSmallestRadiance, 1);
  const CurvePower p = power_of(curve);
  const Lanes power = p.gain * simd::exp(simd::log(x) * p.exponent) - p.offset;
  return curve == DisplayCurve::srgb ? (x <= kSrgbLinear ? x * kSrgbSlope : power) : power;
}

/// d displayed / d radiance, from both; three quotients from one.
PATINA_INLINE Colour display_slopes(const Colour& radiance, const Colour& value, DisplayCurve curve) {
  Colour x, slopes;
  for (std::size_t k = 0; k < 3; ++k) x[k] = simd::clamp(radiance[k], kSmallestRadiance, 1);
  const Lanes inverse = 1 / (x[0] * x[1] * x[2]);
  const CurvePower p = power_of(curve);
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes others = x[(k + 1) % 3] * x[(k + 2) % 3];
    const Lanes power = (value[k] + p.offset) * p.exponent * (others * inverse);
    const bool linear_near_black = curve == DisplayCurve::srgb;
    slopes[k] = inside(radiance[k], kSmallestRadiance, 1,
                       linear_near_black ? (x[k] <= kSrgbLinear ? kSrgbSlope - Lanes{} : power) : power);
  }
  return slopes;
}

PATINA_INLINE void check(const ShadingProblem& problem) {
  assert(problem.fields.size() <= kMostFields && problem.lobes.size() <= kMostLobes);
  static_cast<void>(problem);
}

/// The gradient by the fields at such pixels, with the lamp's share.
PATINA_INLINE void differentiate(const ShadingProblem& problem, const Pixels& pixels, const Colour& image,
                                 const Colour& image_gradient, std::array<Lanes, kMostFields>& by,
                                 Lanes& by_light, Lanes& by_sigma) {
  const Irradiance light = irradiance(problem, pixels);
  const Lanes facing = dot(pixels, ShadingProblem::kNormal);
  const Lanes cosine = simd::clamp(facing, kSmallestCosine, 1);
  std::array<Lanes, kMostLobes> cosines;
  std::array<LobeShape, kMostLobes> shapes;
  Colour unlit;
  for (std::size_t k = 0; k < 3; ++k) unlit[k] = pixels.field[k] * kInvPi * cosine;
  for (std::size_t l = 0; l < problem.lobes.size(); ++l) {
    const LobeFields& lobe = problem.lobes[l];
    cosines[l] = dot(pixels, lobe.normal);
    shapes[l] = shape(pixels, lobe, simd::clamp(cosines[l], kSmallestCosine, 1));
    for (std::size_t k = 0; k < 3; ++k) unlit[k] += pixels.field[lobe.f0 + k] * shapes[l].value;
  }

  Colour radiance, by_unlit;
  Lanes by_irradiance{}, by_cosine{};
  for (std::size_t k = 0; k < 3; ++k) radiance[k] = unlit[k] * light.value;
  const Colour slopes = display_slopes(radiance, image, problem.curve);
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes by_radiance = image_gradient[k] * slopes[k];
    by_irradiance += by_radiance * unlit[k];
    by_unlit[k] = by_radiance * light.value;
    by[k] = by_unlit[k] * kInvPi * cosine;
    by_cosine += by_unlit[k] * kInvPi * pixels.field[k];
  }
  by_light = by_irradiance * light.per_light;
  by_sigma = by_irradiance * light.value * pixels.square_radius;

  // Every field is one lobe's, but for the surface's normal, which lobes may share.
  by_cosine = inside(facing, kSmallestCosine, 1, by_cosine);
  for (std::size_t k = 0; k < 3; ++k) by[ShadingProblem::kNormal + k] = by_cosine * pixels.direction[k];
  for (std::size_t l = 0; l < problem.lobes.size(); ++l) {
    const LobeFields& lobe = problem.lobes[l];
    Lanes by_shape{};
    for (std::size_t k = 0; k < 3; ++k) {
      by_shape += by_unlit[k] * pixels.field[lobe.f0 + k];
      by[lobe.f0 + k] = by_unlit[k] * shapes[l].value;
    }
    const Lanes by_facing = inside(cosines[l], kSmallestCosine, 1, by_shape * shapes[l].by_cosine);
    Colour by_normal;
    for (std::size_t k = 0; k < 3; ++k) by_normal[k] = by_facing * pixels.direction[k];
    by[lobe.roughness_x] = by_shape * shapes[l].by_roughness_x;
    if (!lobe.isotropic()) {
      by[lobe.roughness_y] = by_shape * shapes[l].by_roughness_y;
      by_normal[0] += by_shape * shapes[l].by_nx;
      by_normal[2] += by_shape * shapes[l].by_nz;
    }
    const bool shared = lobe.normal == ShadingProblem::kNormal;
    for (std::size_t k = 0; k < 3; ++k)
      by[lobe.normal + k] = shared ? by[lobe.normal + k] + by_normal[k] : by_normal[k];
  }
}

/// Calls f(i, count) for kLanes pixels at a time: the count is known to the compiler in all but the last.
template <class F>
PATINA_INLINE void by_lanes(std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  std::ptrdiff_t i = begin;
  for (; i + simd::kLanes <= end; i += simd::kLanes) f(i, simd::kLanes);
  if (i < end) f(i, static_cast<int>(end - i));
}

}  // namespace

void shade_pixels(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                  const Planes& image) {
  check(problem);
  Pixels pixels;
  const Subset varying = set_uniform(problem, pixels);
  by_lanes(
      begin, end, [&](std::ptrdiff_t i, int count) __attribute__((always_inline)) {
        gather(problem, varying, i, count, pixels);
        const Lanes light = irradiance(problem, pixels).value;
        const Lanes cosine = simd::clamp(dot(pixels, ShadingProblem::kNormal), kSmallestCosine, 1);
        Colour unlit;
        for (std::size_t k = 0; k < 3; ++k) unlit[k] = pixels.field[k] * kInvPi * cosine;
        for (const LobeFields& lobe : problem.lobes) {
          const Lanes facing = simd::clamp(dot(pixels, lobe.normal), kSmallestCosine, 1);
          const Lanes value = shape(pixels, lobe, facing).value;
          for (std::size_t k = 0; k < 3; ++k) unlit[k] += pixels.field[lobe.f0 + k] * value;
        }
        for (std::size_t k = 0; k < 3; ++k)
          simd::store(displayed(unlit[k] * light, problem.curve), image[k] + i, count);
      });
}

void shade_pixels_backward(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                           const ConstPlanes& image, const ConstPlanes& image_gradient,
                           ShadingGradient& gradient) {
  check(problem);
  Pixels pixels;
  const Subset varying = set_uniform(problem, pixels);
  Subset planes, summed;
  for (std::size_t f = 0; f < problem.fields.size(); ++f) {
    if (gradient.fields[f].plane) planes.add(f);
    if (gradient.fields[f].sum) summed.add(f);
  }
  std::array<Lanes, kMostFields> by, sums;
  for (const std::size_t f : summed) sums[f] = Lanes{};
  Lanes light_sum{}, sigma_sum{};
  by_lanes(
      begin, end, [&](std::ptrdiff_t i, int count) __attribute__((always_inline)) {
        gather(problem, varying, i, count, pixels);
        Colour value, by_image;
        for (std::size_t k = 0; k < 3; ++k) {
          value[k] = simd::load(image[k] + i, count);
          by_image[k] = simd::load_or_zero(image_gradient[k] + i, count);
        }
        Lanes by_light, by_sigma;
        differentiate(problem, pixels, value, by_image, by, by_light, by_sigma);
        light_sum += by_light;
        sigma_sum += by_sigma;
        for (const std::size_t f : planes) simd::store(by[f], gradient.fields[f].plane + i, count);
        for (const std::size_t f : summed) sums[f] += by[f];
      });
  gradient.light += simd::sum(light_sum);
  gradient.vignette_sigma += simd::sum(sigma_sum) / std::pow(problem.vignette_sigma, 3.0);
  for (const std::size_t f : summed) *gradient.fields[f].sum += simd::sum(sums[f]);
}

}  // namespace patina::PATINA_TARGET
