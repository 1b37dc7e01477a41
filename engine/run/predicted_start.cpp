#include "engine/run/predicted_start.h"

#include <system_error>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/prediction/predictor.h"

namespace patina {
namespace {

constexpr int kDraws = 7;
constexpr std::uint64_t kStream = 0x7072'6564;  // of the seed; chains have 1, 2, ...

bool has_predictor(const std::string& material) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(bundled_predictor(material), ignored);
}

}  // namespace

Prediction prediction_for(const RunSettings& settings, const Image& photo) {
  if (!has_predictor(settings.material))
    throw UserError("The material '" + settings.material +
                    "' has no predictor: choose another --start, or train one (resources/predictors).");
  return Predictor::load(bundled_predictor(settings.material), material_table(settings.material))
      .predict(photo, settings.capture);
}

std::vector<Position> predicted_guesses(const RunSettings& settings, const Image& photo,
                                        const Posterior& posterior) {
  const bool asked = settings.start == "predict";
  if (!asked && (settings.start != "map" || !has_predictor(settings.material))) return {};
  const Prediction prediction = prediction_for(settings, photo);
  std::vector<Position> guesses{posterior.position(prediction.likeliest())};
  Rng rng(settings.seed, kStream);
  for (int i = 0; i < kDraws; ++i) guesses.push_back(posterior.position(prediction.draw(rng)));
  return guesses;
}

}  // namespace patina
