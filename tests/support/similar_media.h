#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "engine/io/params_json.h"
#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"

// The paper's motivating example (section 6.1, Figure 4): the posterior of a translucent medium's scattering
// coefficient and anisotropy given one image, all else known, lies along (1 - g) sigma_s = const (Zhao,
// Ramamoorthi, Bala 2014, "High-order similarity relations in radiative transfer").

namespace patina {

/// What decides a medium's look beside its absorption.
struct Scatterer {
  double sigma_s = 0;  ///< 1/cm
  double g = 0;        ///< mean cosine of scattering

  double reduced() const { return (1 - g) * sigma_s; }  ///< what similar media share, 1/cm
};

/// The three media whose images are made, for Figure 4.
inline constexpr std::array<Scatterer, 3> kScatterers{{{1.5, 0.5}, {2.5, 0.4}, {5, 0.4}}};

/// What is known beside them.
inline const std::map<std::string, double> kKnown{{"light", 30}, {"sigma_a", 0.02}, {"iSigma", 15}};

inline Image picture_of(const Scatterer& medium, int resolution) {
  const Renderer renderer("translucent", 1, Capture{});
  ParameterValues values = prior_location(renderer.table());
  for (const auto& [name, value] : kKnown) set_parameter(renderer.table(), name, value, values);
  set_parameter(renderer.table(), "sigma_s", medium.sigma_s, values);
  set_parameter(renderer.table(), "g", medium.g, values);
  return renderer.render(values, resolution);
}

/// The posterior of (sigma_s, g) given a picture; before it they are known to lie in their boxes and hardly
/// more.
inline Posterior posterior_of(const Scatterer& truth, int resolution) {
  PosteriorSettings settings;
  settings.material = "translucent";
  settings.summary = "rings";
  settings.resolution = resolution;
  settings.fixed = kKnown;
  settings.priors = {{"sigma_s", {5, 10, 0.2, 10}}, {"g", {0, 2, -0.9, 0.9}}};
  return Posterior(settings, picture_of(truth, resolution));
}

inline Scatterer scatterer_at(const Posterior& posterior, const Position& position) {
  const ParameterValues values = posterior.values(position);
  const auto value = [&](const char* name) {
    return values.continuous[*posterior.table().find_continuous(name)];
  };
  return {value("sigma_s"), value("g")};
}

/// Draws by the program's default kernel and metric.
inline std::vector<Scatterer> draw_scatterers(const Posterior& posterior, const SampleSettings& settings) {
  const Sample drawn = sample(posterior, *make_kernel("hmc", posterior, 1, 0.25), settings);
  std::vector<Scatterer> scatterers;
  for (Eigen::Index chain = 0; chain < drawn.log_density.cols(); ++chain)
    for (Eigen::Index i = 0; i < drawn.log_density.rows(); ++i)
      scatterers.push_back(scatterer_at(
          posterior, {Eigen::Vector2d(drawn.coordinates[0](i, chain), drawn.coordinates[1](i, chain)), {}}));
  return scatterers;
}

}  // namespace patina
