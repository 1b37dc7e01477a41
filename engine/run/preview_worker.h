#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/material/capture.h"
#include "engine/material/maps.h"
#include "engine/material/parameter.h"

namespace patina {

struct PreviewRequest {
  std::string material;
  std::uint64_t z_seed = 1;
  Capture capture;
  ParameterValues values;
  int resolution = 512;
  bool tile = false;  ///< maps that repeat without a seam, of a material that has them
};

struct Preview {
  std::uint64_t ticket = 0;  ///< of the request it answers
  PreviewRequest request;
  MaterialMaps maps;
  bool repeats = false;  ///< the maps are such a tile
};

/// Makes maps on a thread of its own; the newest request wins, older ones not yet begun are dropped.
class PreviewWorker {
 public:
  explicit PreviewWorker(std::function<void()> wake = {});
  ~PreviewWorker();

  std::uint64_t request(PreviewRequest request);     ///< returns its ticket, from 1; tickets grow
  std::optional<Preview> take();                     ///< the newest finished preview, once
  std::string error_of(std::uint64_t ticket) const;  ///< one sentence, if it was the last to fail; or empty

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
