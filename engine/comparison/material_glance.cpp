#include "engine/comparison/material_glance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/prediction/material_chooser.h"
#include "engine/run/predicted_start.h"
#include "engine/run/stopwatch.h"
#include "engine/sampling/evidence.h"

namespace patina {
namespace {

constexpr double kSure = 0.95;

/// The network, if it can be read and has learned all of these.
std::optional<MaterialChooser> chooser_of(const std::vector<std::string>& materials) {
  try {
    MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
    const auto known = [&](const std::string& name) {
      return std::ranges::count(chooser.materials(), name) > 0;
    };
    if (std::ranges::all_of(materials, known)) return chooser;
  } catch (const UserError&) {
  }
  return std::nullopt;
}

std::string sentence_of(const std::vector<RankedMaterial>& ranked) {
  if (ranked.size() == 1 || ranked[0].probability > kSure)
    return "At a glance this is " + ranked[0].material + ".";
  return format("At a glance this is %s (%.0f %%) or %s (%.0f %%).", ranked[0].material.c_str(),
                100 * ranked[0].probability, ranked[1].material.c_str(), 100 * ranked[1].probability);
}

}  // namespace

bool can_glance(const std::vector<std::string>& materials) { return chooser_of(materials).has_value(); }

std::vector<double> glances(const Image& photo, const std::vector<std::string>& materials) {
  const std::optional<MaterialChooser> chooser = chooser_of(materials);
  if (!chooser) return {};
  const Eigen::VectorXd log_p = chooser->log_probabilities(photo);
  std::vector<double> of_these;
  for (const std::string& name : materials)
    of_these.push_back(log_p[std::ranges::find(chooser->materials(), name) - chooser->materials().begin()]);
  const double all = log_sum_exp(of_these);
  for (double& one : of_these) one -= all;
  return of_these;
}

MaterialRanking glance(const Image& photo, const RankSettings& settings) {
  double seconds = 0;
  MaterialRanking ranking;
  {
    const Stopwatch stopwatch(seconds);
    const std::vector<double> log_p = glances(photo, settings.materials);
    if (log_p.empty())
      throw UserError(
          "One of the materials was not learned by the network that tells them apart: compare by searches, "
          "or train it again (resources/predictors).");
    for (std::size_t i = 0; i < log_p.size(); ++i) {
      const Prediction prediction = prediction_for(settings.materials[i], photo, settings.capture);
      RankedMaterial& ranked = ranking.materials.emplace_back();
      ranked.material = settings.materials[i];
      ranked.parameters =
          static_cast<int>(prediction.table.continuous.size() + prediction.table.discrete.size());
      ranked.log_evidence = log_p[i];
      ranked.probability = std::exp(log_p[i]);
      ranked.match = prediction.likeliest();
    }
  }
  for (RankedMaterial& ranked : ranking.materials) ranked.seconds = seconds;
  std::ranges::stable_sort(ranking.materials, std::greater(), &RankedMaterial::log_evidence);
  ranking.summary = "glance";
  ranking.sentence = sentence_of(ranking.materials);
  return ranking;
}

}  // namespace patina
