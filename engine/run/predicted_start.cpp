#include "engine/run/predicted_start.h"

#include <Eigen/Cholesky>

#include <memory>
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

Eigen::VectorXd informed_place(const Posterior& posterior, const ParameterValues& values) {
  return posterior.position(values).continuous(posterior.informed());
}

/// From draws, as a posterior may have priors, and so coordinates, of its own.
Region region_of(const Prediction& prediction, const Posterior& posterior) {
  constexpr int kRegionDraws = 400;
  const Eigen::VectorXd centre = informed_place(posterior, prediction.likeliest());
  Eigen::MatrixXd away(centre.size(), kRegionDraws);
  Rng rng(kStream);
  for (int i = 0; i < kRegionDraws; ++i)
    away.col(i) = informed_place(posterior, prediction.draw(rng)) - centre;
  return {centre, Eigen::MatrixXd(away * away.transpose() / kRegionDraws).llt().matrixL()};
}

}  // namespace

Prediction prediction_for(const std::string& material, const Image& photo, const Capture& capture) {
  if (!has_predictor(material))
    throw UserError("The material '" + material +
                    "' has no predictor: choose another --start, or train one (resources/predictors).");
  return Predictor::load(bundled_predictor(material), material_table(material)).predict(photo, capture);
}

Guess region_guess(const Posterior& posterior, const Capture& capture) {
  const std::string& material = posterior.table().material;
  if (!has_predictor(material)) return {};
  try {
    const auto predictor = std::make_shared<const Predictor>(
        Predictor::load(bundled_predictor(material), material_table(material)));
    return {[=, &posterior](const Image& photo) {
              return informed_place(posterior, predictor->predict(photo, capture).likeliest());
            },
            [=, &posterior](const Image& photo) {
              return region_of(predictor->predict(photo, capture), posterior);
            }};
  } catch (const UserError&) {
    return {};  // see predicted_guesses()
  }
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
