#include "gui/ranking_view.h"

#include <cmath>

#include "engine/comparison/ranking_words.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kGoodMatch = 1.2;  // misfit; 1 is usual for a material that fits

}  // namespace

std::string likelihood_text(const RankedMaterial& material) {
  const double percent = 100 * material.probability;
  std::string text = percent > 99 ? "over 99 %" : percent < 1 ? "under 1 %" : number_text(percent, 2) + " %";
  return material.error ? text : text + " at first sight";
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
  const double factor = std::exp(std::hypot(error_of(all[0]), error_of(all[1])));
  return hint + "how many times likelier the first is than the next may itself be off by a factor of " +
         number_text(factor, 1) + ", and no material here may be the true one. Look at what it renders.";
}

}  // namespace patina
