#pragma once

#include <memory>
#include <vector>

#include "engine/image.h"
#include "engine/posterior/posterior.h"
#include "engine/prediction/prediction.h"
#include "engine/run/run_settings.h"

namespace patina {

/// What the material's predictor makes of the photo.
/// @throws UserError if the material has none, or it cannot be used
Prediction prediction_for(const RunSettings& settings, const Image& photo);

/// Where a search does well to look first: the prediction's likeliest place and draws about it. Empty for
/// starts that know better, and for a material without a predictor, unless RunSettings::start asks for one.
/// @throws UserError as prediction_for() if it is asked for
std::vector<Position> predicted_guesses(const RunSettings& settings, const Image& photo,
                                        const Posterior& posterior);

}  // namespace patina
