#include "engine/run/asked_start.h"

#include "engine/io/params_json.h"
#include "engine/material/registry.h"
#include "engine/run/predicted_start.h"
#include "engine/sampling/prior_draw.h"

namespace patina {

ParameterValues start_values(const ParameterTable& table, const RunSettings& settings) {
  ParameterValues values = prior_location(table);
  for (const auto& [name, value] : settings.start_at) set_parameter(table, name, value, values);
  return values;
}

std::function<Position(Rng&)> start_of(const Posterior& posterior, const RunSettings& settings,
                                       const Image& photo) {
  if (settings.start == "map") return {};
  if (settings.start == "predict")
    return [&, prediction = prediction_for(settings.material, photo, settings.capture)](Rng& rng) {
      return posterior.position(prediction.draw(rng));
    };
  if (settings.start == "prior") return [&](Rng& rng) { return prior_draw(posterior, rng); };
  return [place = posterior.position(start_values(posterior.table(), settings))](Rng&) { return place; };
}

}  // namespace patina
