#include "gui/ranking_view.h"

#include <algorithm>

#include "engine/run/ranking_words.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kGoodMatch = 1.2;  // misfit; 1 is usual for a material that fits

}  // namespace

Standing standing(const RankedMaterial& material, const RankedMaterial& first) {
  if (material.distance && first.distance) {
    const double further = 100 * (*material.distance / *first.distance - 1);
    return {std::min(1.0, *first.distance / *material.distance),
            further <= 0 ? "nearest" : number_text(further, 2) + " % further off"};
  }
  const double percent = 100 * material.probability;
  const std::string text = percent > 99  ? "over 99 %"
                           : percent < 1 ? "under 1 %"
                                         : number_text(percent, 2) + " %";
  return {material.probability, material.error ? text : text + " at first sight"};
}

std::string fit_text(const RankedMaterial& material) {
  if (!material.misfit) return "";
  const char* how = *material.misfit <= kGoodMatch   ? "fits"
                    : *material.misfit <= kPoorMatch ? "fits roughly"
                                                     : "does not fit";
  return std::string(how) + " (" + number_text(*material.misfit, 2) + ")";
}

std::string uncertainty_text(const MaterialRanking& ranking) {
  const std::string hint = "This is a hint, not a verdict: ";
  const auto& all = ranking.materials;
  if (all.size() < 2) return hint + "there was nothing to compare it with.";
  if (within_error(all[0], all[1]))
    return hint + "try " + all[0].material + " and " + all[1].material + ", and look at what they render.";
  return hint + "no material here may be the true one. Look at what " + all[0].material + " renders.";
}

}  // namespace patina
