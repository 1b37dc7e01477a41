#pragma once

#include <cstdint>

#include "engine/posterior/camera.h"

namespace patina {

/// How much is simulated to learn a likelihood.
struct SimulationSettings {
  int photos = 300;  ///< of a round
  int rounds = 4;
  Camera camera;  ///< that the photo is thought to be taken with
  std::uint64_t seed = 1;
};

}  // namespace patina
