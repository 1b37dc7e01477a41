#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/simulate.h"
#include "engine/prediction/prediction.h"

namespace patina {

/// What the material's predictor makes of the photo.
/// @throws UserError if the material has none, or it cannot be used
Prediction prediction_for(const std::string& material, const Image& photo, const Capture& capture);

/// Where a search does well to look first: the prediction's likeliest place and draws about it. Empty for a
/// material without a predictor, or with one that cannot be used.
std::vector<Position> predicted_guesses(const Posterior& posterior, const Image& photo,
                                        const Capture& capture, std::uint64_t seed);

/// The predictor's normal distribution of a posterior's informed coordinates. Empty for a material without a
/// predictor, or with one that cannot be used. It refers to the posterior.
Guess region_guess(const Posterior& posterior, const Capture& capture);

}  // namespace patina
