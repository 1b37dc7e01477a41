#include "engine/run/predicted_start.h"

#include <Eigen/Cholesky>

#include <memory>
#include <system_error>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/prediction/predictor.h"

namespace patina {
namespace {

static_assert(Camera{}.least_side == 2 * Predictor::kSide, "predictors are to see pixels that are means");

constexpr int kDraws = 7;
constexpr std::uint64_t kStream = 0x7072'6564;  // of the seed; chains have 1, 2, ...

bool has_predictor(const std::string& material) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(bundled_predictor(material), ignored);
}

Predictor load_predictor(const std::string& material) {
  return Predictor::load(bundled_predictor(material), material_table(material));
}

/// Null where there is none, or none of the material as it is now: who has given it another parameter can fit
/// it all the same.
std::shared_ptr<const Predictor> usable_predictor(const std::string& material) {
  if (!has_predictor(material)) return nullptr;
  try {
    return std::make_shared<const Predictor>(load_predictor(material));
  } catch (const UserError&) {
    return nullptr;
  }
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
  return load_predictor(material).predict(photo, capture);
}

Guess region_guess(const Posterior& posterior, const Capture& capture) {
  const auto predictor = usable_predictor(posterior.table().material);
  if (!predictor) return {};
  return {[=, &posterior](const Image& photo) {
            return informed_place(posterior, predictor->predict(photo, capture).likeliest());
          },
          [=, &posterior](const Image& photo) {
            return region_of(predictor->predict(photo, capture), posterior);
          }};
}

std::vector<Position> predicted_guesses(const Posterior& posterior, const Image& photo,
                                        const Capture& capture, std::uint64_t seed) {
  const auto predictor = usable_predictor(posterior.table().material);
  if (!predictor) return {};
  const Prediction prediction = predictor->predict(photo, capture);
  std::vector<Position> guesses{posterior.position(prediction.likeliest())};
  Rng rng(seed, kStream);
  for (int i = 0; i < kDraws; ++i) guesses.push_back(posterior.position(prediction.draw(rng)));
  return guesses;
}

}  // namespace patina
