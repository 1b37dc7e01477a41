#pragma once

#include <filesystem>
#include <vector>

#include "engine/image.h"
#include "engine/run/draw.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"

namespace patina {

/// A run as a front end sees it, whether its sampler is in this process (Run) or it is read from a
/// directory that may still be growing (RunReader). Called from one thread; never blocks on sampling.
class DrawSource {
 public:
  virtual ~DrawSource() = default;

  virtual const std::filesystem::path& directory() const = 0;
  virtual const RunSettings& settings() const = 0;
  virtual const ParameterTable& table() const = 0;  ///< with the priors in force
  virtual const Image& photo() const = 0;           ///< square, sRGB in [0,1]

  virtual std::vector<Draw> take_draws() = 0;  ///< those that arrived since the last call
  virtual RunStatus status() const = 0;

  virtual bool can_control() const = 0;  ///< false for a run that another process makes
  virtual void pause() = 0;
  virtual void resume() = 0;
  virtual void stop() = 0;  ///< asks; returns at once
};

}  // namespace patina
