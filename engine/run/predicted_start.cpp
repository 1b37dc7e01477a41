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

Prediction prediction_for(const std::string& material, const Image& photo, const Capture& capture) {
  if (!has_predictor(material))
    throw UserError("The material '" + material +
                    "' has no predictor: choose another --start, or train one (resources/predictors).");
  return Predictor::load(bundled_predictor(material), material_table(material)).predict(photo, capture);
}

std::vector<Position> predicted_guesses(const Posterior& posterior, const Image& photo,
                                        const Capture& capture, std::uint64_t seed) {
  const std::string& material = posterior.table().material;
  if (!has_predictor(material)) return {};
  try {
    const Prediction prediction = prediction_for(material, photo, capture);
    std::vector<Position> guesses{posterior.position(prediction.likeliest())};
    Rng rng(seed, kStream);
    for (int i = 0; i < kDraws; ++i) guesses.push_back(posterior.position(prediction.draw(rng)));
    return guesses;
  } catch (const UserError&) {
    return {};  // who has given a material another parameter can fit it all the same
  }
}

}  // namespace patina
