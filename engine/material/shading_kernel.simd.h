// Read once for each target by each_target.h.
// Formulae: models.md "Capture", as in shading.cpp, whose tensor version is the reference of the tests. Here
// each is written beside its derivative.
namespace patina::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

constexpr float kSmallestCosine = 1e-3f, kSmallestRadiance = 1e-6f, kLeastSquareLength = 1e-8f;
constexpr std::size_t kMostLobes = 8;
constexpr float kInvPi = std::numbers::inv_pi_v<float>, kFourPi = 4 * std::numbers::pi_v<float>;

using Colour = std::array<Lanes, 3>;

/// Which fields and lobes there are.
struct AnyLobes {
  static constexpr std::size_t kMost = kMostFields;
  std::span<const Field> fields;
  std::span<const LobeFields> lobes;

  bool is_plane(std::size_t field) const { return !fields[field].uniform; }
  template <class F>
  PATINA_INLINE void over_fields(const F& f) const {
    for (std::size_t field = 0; field < fields.size(); ++field) f(field);
  }
};

/// The same where the compiler knows it, so that a vector's numbers stay in registers.
/// @param kPlanes  a bit for each field
template <std::uint32_t kPlanes, LobeFields... kLobes>
struct Lobes {
  static constexpr std::size_t kMost = std::max({ShadingProblem::kLobes, kLobes.roughness_y + 1 ...});
  static constexpr std::array<LobeFields, sizeof...(kLobes)> lobes = {kLobes...};

  static constexpr bool is_plane(std::size_t field) { return (kPlanes >> field & 1) != 0; }
  template <class F>
  PATINA_INLINE void over_fields(const F& f) const {
    [&]<std::size_t... kField>(std::index_sequence<kField...>) __attribute__((always_inline)) {
      (f(kField), ...);
    }
    (std::make_index_sequence<kMost>{});
  }

  static bool are_of(const ShadingProblem& problem) {
    if (problem.fields.size() != kMost || !std::ranges::equal(problem.lobes, lobes)) return false;
    for (std::size_t f = 0; f < kMost; ++f)
      if (problem.fields[f].uniform == is_plane(f)) return false;
    return true;
  }
};

constexpr std::uint32_t kColourPlanes = 7, kNormalPlanes = 7 << ShadingProblem::kNormal;
constexpr LobeFields kLobe{ShadingProblem::kNormal, 6, 9, 9},
    kStretchedLobe{ShadingProblem::kNormal, 6, 9, 10};
using Bump = Lobes<kNormalPlanes, kLobe>;
using RoughBump = Lobes<kNormalPlanes | 1 << 9, kLobe>;  // leather, plaster
using Wood = Lobes<kColourPlanes | kNormalPlanes | 1 << 9, kLobe>;
using Metal = Lobes<kNormalPlanes, kStretchedLobe>;
using Translucent = Lobes<kColourPlanes>;
using Flake = Lobes<7 << 10 | 1 << 16, kLobe, LobeFields{10, 13, 16, 16},
                    LobeFields{ShadingProblem::kNormal, 17, 20, 20}>;

/// Calls f(layout).
template <class F>
void with_layout(const ShadingProblem& problem, const F& f) {
  const auto is = [&]<class... Layout>(Layout... layout) {
    return ((Layout::are_of(problem) && (f(layout), true)) || ...);
  };
  if (!is(Bump{}, RoughBump{}, Wood{}, Metal{}, Translucent{}, Flake{}))
    f(AnyLobes{problem.fields, problem.lobes});
}

/// The fields and the view at the pixels that are taken at once.
template <class Layout>
struct Pixels {
  std::array<Lanes, Layout::kMost> field;
  Colour direction;
  Lanes inverse_square_distance, square_radius;
};

template <class Layout>
PATINA_INLINE Pixels<Layout> gather(const ShadingProblem& problem, const Layout& layout, std::ptrdiff_t row,
                                    std::ptrdiff_t column, int count) {
  const std::ptrdiff_t i = row * problem.side + column;
  Pixels<Layout> pixels;
  layout.over_fields([&](std::size_t f) __attribute__((always_inline)) {
    const float* field = problem.fields[f].data;
    pixels.field[f] = layout.is_plane(f) ? simd::load(field + i, count) : *field - Lanes{};
  });
  const Lanes x = simd::load(problem.offset + column, count), y = -problem.offset[row] - Lanes{};
  const Lanes inverse_distance = simd::load(problem.inverse_distance + i, count);
  pixels.direction = {-x * inverse_distance, -y * inverse_distance, problem.camera_cm * inverse_distance};
  pixels.inverse_square_distance = inverse_distance * inverse_distance;
  pixels.square_radius = x * x + y * y;
  return pixels;
}

template <class Pixels>
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

template <class Pixels>
PATINA_INLINE Irradiance irradiance(const ShadingProblem& problem, const Pixels& pixels) {
  const float per_square =
      -0.5f * std::numbers::log2e_v<float> / (problem.vignette_sigma * problem.vignette_sigma);
  const Lanes exponent = simd::max(-126 - Lanes{}, pixels.square_radius * per_square);
  const Lanes per_light = simd::exp2(exponent) * pixels.inverse_square_distance;
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

template <class Pixels>
PATINA_INLINE LobeShape anisotropic_shape(const Pixels& pixels, const LobeFields& lobe, const Lanes& c) {
  const Lanes nx = pixels.field[lobe.normal], nz = pixels.field[lobe.normal + 2];
  const Lanes rx = pixels.field[lobe.roughness_x], ry = pixels.field[lobe.roughness_y];
  const Lanes &dx = pixels.direction[0], &dz = pixels.direction[2];
  const Lanes square_length = nx * nx + nz * nz;
  const Lanes inverse_length = 1 / simd::sqrt(simd::max(square_length, kLeastSquareLength - Lanes{}));
  const Lanes hx = (nz * dx - nx * dz) * inverse_length, hy2 = 1 - hx * hx - c * c;
  const Lanes square_hy = simd::max(hy2, Lanes{});
  const Lanes inverse_rx = 1 / rx, inverse_ry = 1 / ry;
  const Lanes inverse_ax = inverse_rx * inverse_rx, inverse_ay = inverse_ry * inverse_ry;
  const Lanes x2 = hx * hx * inverse_ax * inverse_ax, y2 = square_hy * inverse_ay * inverse_ay;
  const Lanes tail = x2 + y2 + c * c;
  const Lanes inverse = 1 / (c * tail);
  const Lanes value = inverse_ax * inverse_ay * (inverse * inverse * c) * (1 / kFourPi);
  const Lanes by_tail = -2 * value * (inverse * c);
  const Lanes hy_part = hy2 > 0 ? inverse_ay * inverse_ay : Lanes{};
  const Lanes by_hx = by_tail * 2 * hx * (inverse_ax * inverse_ax - hy_part);
  const Lanes pull = square_length > kLeastSquareLength ? hx * inverse_length * inverse_length : Lanes{};
  return {.value = value,
          .by_cosine = by_tail * 2 * c * (1 - hy_part) - value * (inverse * tail),
          .by_roughness_x = (by_tail * -2 * x2 - value) * 2 * inverse_rx,
          .by_roughness_y = (by_tail * -2 * y2 - value) * 2 * inverse_ry,
          .by_nx = by_hx * (-dz * inverse_length - pull * nx),
          .by_nz = by_hx * (dx * inverse_length - pull * nz)};
}

template <class Pixels>
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
  const Lanes power = p.gain * simd::pow(x, p.exponent) - p.offset;
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
template <class Layout>
PATINA_INLINE void differentiate(const ShadingProblem& problem, const Layout& layout,
                                 const Pixels<Layout>& pixels, const Colour& image,
                                 const Colour& image_gradient, std::array<Lanes, Layout::kMost>& by,
                                 Lanes& by_light, Lanes& by_sigma) {
  const Irradiance light = irradiance(problem, pixels);
  const Lanes facing = dot(pixels, ShadingProblem::kNormal);
  const Lanes cosine = simd::clamp(facing, kSmallestCosine, 1);
  std::array<Lanes, kMostLobes> cosines;
  std::array<LobeShape, kMostLobes> shapes;
  Colour unlit;
  for (std::size_t k = 0; k < 3; ++k) unlit[k] = pixels.field[k] * kInvPi * cosine;
  for (std::size_t l = 0; l < layout.lobes.size(); ++l) {
    const LobeFields& lobe = layout.lobes[l];
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
  for (std::size_t l = 0; l < layout.lobes.size(); ++l) {
    const LobeFields& lobe = layout.lobes[l];
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

/// Calls f(row, column, count) for kLanes pixels of a row at a time.
template <class F>
PATINA_INLINE void over_rows(std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t side, const F& f) {
  for (std::ptrdiff_t row = begin; row < end; ++row)
    simd::over(
        0, side, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
          f(row, column, count);
        });
}

template <class Layout>
void shade(const ShadingProblem& problem, const Layout& layout, std::ptrdiff_t begin, std::ptrdiff_t end,
           const Planes& image) {
  over_rows(
      begin, end,
      problem.side, [&](std::ptrdiff_t row, std::ptrdiff_t column, int count) __attribute__((always_inline)) {
        const Pixels<Layout> pixels = gather(problem, layout, row, column, count);
        const Lanes light = irradiance(problem, pixels).value;
        const Lanes cosine = simd::clamp(dot(pixels, ShadingProblem::kNormal), kSmallestCosine, 1);
        Colour unlit;
        for (std::size_t k = 0; k < 3; ++k) unlit[k] = pixels.field[k] * kInvPi * cosine;
        for (const LobeFields& lobe : layout.lobes) {
          const Lanes facing = simd::clamp(dot(pixels, lobe.normal), kSmallestCosine, 1);
          const Lanes value = shape(pixels, lobe, facing).value;
          for (std::size_t k = 0; k < 3; ++k) unlit[k] += pixels.field[lobe.f0 + k] * value;
        }
        const std::ptrdiff_t i = row * problem.side + column;
        for (std::size_t k = 0; k < 3; ++k)
          simd::store(displayed(unlit[k] * light, problem.curve), image[k] + i, count);
      });
}

template <class Layout>
void shade_backward(const ShadingProblem& problem, const Layout& layout, std::ptrdiff_t begin,
                    std::ptrdiff_t end, const ConstPlanes& image, const ConstPlanes& image_gradient,
                    ShadingGradient& gradient) {
  std::array<Lanes, Layout::kMost> by, sums;
  layout.over_fields([&](std::size_t f) { sums[f] = Lanes{}; });
  Lanes light_sum{}, sigma_sum{};
  over_rows(
      begin, end,
      problem.side, [&](std::ptrdiff_t row, std::ptrdiff_t column, int count) __attribute__((always_inline)) {
        const std::ptrdiff_t i = row * problem.side + column;
        Colour value, by_image;
        for (std::size_t k = 0; k < 3; ++k) {
          value[k] = simd::load(image[k] + i, count);
          by_image[k] = simd::load_or_zero(image_gradient[k] + i, count);
        }
        const Pixels<Layout> pixels = gather(problem, layout, row, column, count);
        Lanes by_light, by_sigma;
        differentiate(problem, layout, pixels, value, by_image, by, by_light, by_sigma);
        light_sum += by_light;
        sigma_sum += by_sigma;
        layout.over_fields([&](std::size_t f) __attribute__((always_inline)) {
          if (!layout.is_plane(f)) {
            sums[f] += by[f];
          } else if (gradient.fields[f].plane) {
            simd::store(by[f], gradient.fields[f].plane + i, count);
          }
        });
      });
  gradient.light += simd::sum(light_sum);
  gradient.vignette_sigma += simd::sum(sigma_sum) / std::pow(problem.vignette_sigma, 3.0);
  layout.over_fields([&](std::size_t f) {
    if (gradient.fields[f].sum) *gradient.fields[f].sum += simd::sum(sums[f]);
  });
}

}  // namespace

void shade_pixels(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                  const Planes& image) {
  check(problem);
  with_layout(problem, [&](const auto& layout) { shade(problem, layout, begin, end, image); });
}

void shade_pixels_backward(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                           const ConstPlanes& image, const ConstPlanes& image_gradient,
                           ShadingGradient& gradient) {
  check(problem);
  with_layout(problem, [&](const auto& layout) {
    shade_backward(problem, layout, begin, end, image, image_gradient, gradient);
  });
}

}  // namespace patina::PATINA_TARGET
