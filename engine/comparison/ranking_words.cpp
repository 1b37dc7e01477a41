#include "engine/comparison/ranking_words.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "engine/format.h"
#include "engine/sampling/evidence.h"

namespace patina {
namespace {

// What Laplace's approximation is taken to be off by, nats: it has no error of its own to tell.
constexpr double kLaplaceError = 3;

/// "12 times", "about 10^17 times" beyond what a number says.
std::string times(double nats) {
  return nats < std::log(1e4) ? format("%.2g times", std::exp(nats))
                              : format("about 10^%.0f times", nats / std::log(10.0));
}

/// The paper's Figure 8: a material that is not the photo's can be fitted, but not well.
std::string none_fits(const RankedMaterial& best) {
  std::string sentence = format(
      "None of them fits: the best match, of %s, is off by %.1f times what is usual for a material that fits",
      best.material.c_str(), *best.misfit);
  if (best.misfit_of_another_sample)
    sentence += format("; another sample of that match would be off by %.1f", *best.misfit_of_another_sample);
  return sentence + ".";
}

}  // namespace

double error_of(const RankedMaterial& material) { return material.error.value_or(kLaplaceError); }

double log_odds(const RankedMaterial& material) { return material.log_evidence + material.glance; }

bool within_error(const RankedMaterial& a, const RankedMaterial& b) {
  return std::abs(log_odds(a) - log_odds(b)) < 2 * std::hypot(error_of(a), error_of(b));
}

double foretold(const RankedMaterial& material) {
  return std::accumulate(material.quarters.begin(), material.quarters.end(), 0.0);
}

bool foretells_worse(const RankedMaterial& a, const RankedMaterial& b) {
  const std::size_t n = std::min(a.quarters.size(), b.quarters.size());
  if (n < 2) return false;
  const auto count = static_cast<Eigen::Index>(n);
  const Eigen::ArrayXd ahead = Eigen::Map<const Eigen::ArrayXd>(b.quarters.data(), count) -
                               Eigen::Map<const Eigen::ArrayXd>(a.quarters.data(), count);
  const double variance = (ahead - ahead.mean()).square().sum() / static_cast<double>(n - 1);
  return ahead.mean() > 2 * std::sqrt(variance / static_cast<double>(n));
}

void put_in_order(std::vector<RankedMaterial>& materials) {
  if (materials.empty()) return;
  std::ranges::stable_sort(materials, std::greater(), log_odds);
  std::vector<double> odds;
  std::ranges::transform(materials, std::back_inserter(odds), log_odds);
  const double all = log_sum_exp(odds);
  for (RankedMaterial& material : materials) material.probability = std::exp(log_odds(material) - all);
  const auto tied = [&](const RankedMaterial& m) { return within_error(m, materials.front()); };
  const RankedMaterial* seer = &materials.front();
  for (const RankedMaterial& rival : materials)
    if (tied(rival) && foretold(rival) > foretold(*seer)) seer = &rival;
  auto preferred = materials.end();
  for (auto rival = materials.begin(); rival != materials.end(); ++rival)
    if (tied(*rival) && !foretells_worse(*rival, *seer) &&
        (preferred == materials.end() || rival->parameters < preferred->parameters))
      preferred = rival;
  std::rotate(materials.begin(), preferred, preferred + 1);
}

std::string in_words(const MaterialRanking& ranking) {
  const auto& all = ranking.materials;
  if (all.empty()) return "There was nothing to compare.";
  const RankedMaterial& first = all.front();
  if (first.misfit.value_or(0) > kPoorMatch) return none_fits(first);
  if (all.size() == 1) return first.material + ", the only one compared.";
  const RankedMaterial& next = all[1];
  if (within_error(first, next)) {
    const std::string both = first.material + " or " + next.material;
    if (foretells_worse(next, first))
      return both + ": the photo cannot tell them apart within the error of the comparison, but " +
             first.material + " foretells quarters of it from the opposite ones better.";
    return both + ": the photo cannot tell them apart within the error of the comparison" +
           (first.parameters < next.parameters ? ", and " + first.material + " is the simpler." : ".");
  }
  return first.material + ", " + times(log_odds(first) - log_odds(next)) + " likelier than " + next.material +
         ", the next.";
}

}  // namespace patina
