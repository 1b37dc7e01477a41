#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "engine/material/maps.h"

namespace patina::testing {

inline Image filled(int n, std::initializer_list<float> value) {
  Image image(n, n, static_cast<int>(value.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = value.begin()[i % value.size()];
  return image;
}

/// A flat surface of one colour and one lobe.
inline MaterialMaps flat_maps(int n) {
  MaterialMaps maps;
  maps.base_color = filled(n, {0.3f, 0.2f, 0.1f});
  maps.height = filled(n, {0});
  maps.normal = filled(n, {0, 0, 1});
  maps.lobes.push_back({maps.normal, filled(n, {0.4f, 0.4f}), {0.04f, 0.05f, 0.06f}});
  maps.light = 800;
  maps.vignette_sigma = 12;
  return maps;
}

inline double srgb(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace patina::testing
