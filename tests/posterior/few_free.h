#pragma once

#include <set>
#include <string>

#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/prior_transform.h"

namespace patina {

/// A material by a summary at 32 pixels, given a render of the middle of its prior; all but some parameters
/// are held there.
inline Posterior with_free(const std::string& material, const std::set<std::string>& free,
                           const std::string& summary = "means") {
  const Renderer renderer(material, 2, Capture{});
  const ParameterValues usual = prior_location(renderer.table());
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = 32;
  settings.summary = summary;
  for (std::size_t i = 0; i < usual.continuous.size(); ++i)
    if (const std::string& name = renderer.table().continuous[i].name; !free.contains(name))
      settings.fixed[name] = usual.continuous[i];
  return Posterior(settings, renderer.render(usual, 32));
}

}  // namespace patina
