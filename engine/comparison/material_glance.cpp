#include "engine/comparison/material_glance.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/prediction/material_chooser.h"
#include "engine/run/predicted_start.h"
#include "engine/run/stopwatch.h"

namespace patina {
namespace {

constexpr double kSure = 0.95;

std::string sentence_of(const std::vector<RankedMaterial>& ranked) {
  if (ranked.size() == 1 || ranked[0].probability > kSure)
    return "At a glance this is " + ranked[0].material + ".";
  return format("At a glance this is %s (%.0f %%) or %s (%.0f %%).", ranked[0].material.c_str(),
                100 * ranked[0].probability, ranked[1].material.c_str(), 100 * ranked[1].probability);
}

}  // namespace

bool can_glance(const std::vector<std::string>& materials) {
  try {
    const std::vector<std::string> known = MaterialChooser::load(bundled_chooser()).materials();
    return std::ranges::all_of(materials,
                               [&](const std::string& name) { return std::ranges::count(known, name) > 0; });
  } catch (const UserError&) {
    return false;
  }
}

MaterialRanking glance(const Image& photo, const RankSettings& settings) {
  double seconds = 0;
  MaterialRanking ranking;
  {
    const Stopwatch stopwatch(seconds);
    const MaterialChooser chooser = MaterialChooser::load(bundled_chooser());
    const Eigen::VectorXd log_p = chooser.log_probabilities(photo);
    double total = 0;
    for (const std::string& name : settings.materials) {
      const Prediction prediction = prediction_for(name, photo, settings.capture);
      const auto place = std::ranges::find(chooser.materials(), name) - chooser.materials().begin();
      RankedMaterial& ranked = ranking.materials.emplace_back();
      ranked.material = name;
      ranked.parameters =
          static_cast<int>(prediction.table.continuous.size() + prediction.table.discrete.size());
      ranked.log_evidence = log_p[place];
      ranked.match = prediction.likeliest();
      total += std::exp(log_p[place]);
    }
    for (RankedMaterial& ranked : ranking.materials)
      ranked.probability = std::exp(ranked.log_evidence) / total;
  }
  for (RankedMaterial& ranked : ranking.materials) ranked.seconds = seconds;
  std::ranges::stable_sort(ranking.materials, std::greater(), &RankedMaterial::log_evidence);
  ranking.summary = "glance";
  ranking.sentence = sentence_of(ranking.materials);
  return ranking;
}

}  // namespace patina
