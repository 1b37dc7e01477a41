#include "engine/run/ranking_words.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace patina {
namespace {

// How far Laplace's approximation was from sequential Monte Carlo where both were made, nats.
constexpr double kLaplaceError = 3;

double error_of(const RankedMaterial& material) {
  return std::isfinite(material.error) ? material.error : kLaplaceError;
}

/// "12 times", "about e^40 times" beyond what a number says.
std::string times(double nats) {
  char text[32];
  if (nats < std::log(1e4))
    std::snprintf(text, sizeof text, "%.2g times", std::exp(nats));
  else
    std::snprintf(text, sizeof text, "about 10^%.0f times", nats / std::log(10.0));
  return text;
}

}  // namespace

bool within_error(const RankedMaterial& a, const RankedMaterial& b) {
  return std::abs(a.log_evidence - b.log_evidence) < 2 * std::hypot(error_of(a), error_of(b));
}

void put_in_order(std::vector<RankedMaterial>& materials) {
  if (materials.empty()) return;
  std::ranges::stable_sort(materials, std::greater(), &RankedMaterial::log_evidence);
  const double best = materials.front().log_evidence;
  double total = 0;
  for (const RankedMaterial& material : materials) total += std::exp(material.log_evidence - best);
  for (RankedMaterial& material : materials)
    material.probability = std::exp(material.log_evidence - best) / total;
  auto simplest = materials.begin();
  for (auto rival = materials.begin() + 1; rival != materials.end(); ++rival)
    if (rival->parameters < simplest->parameters && within_error(*rival, materials.front())) simplest = rival;
  std::rotate(materials.begin(), simplest, simplest + 1);
}

std::string in_words(const MaterialRanking& ranking) {
  const auto& all = ranking.materials;
  if (all.empty()) return "There was nothing to compare.";
  const RankedMaterial& first = all.front();
  if (all.size() == 1) return first.material + ", the only one compared.";
  const RankedMaterial& next = all[1];
  if (within_error(first, next))
    return first.material + " or " + next.material +
           ": the photo cannot tell them apart within the error of the comparison" +
           (first.parameters < next.parameters ? ", and " + first.material + " is the simpler." : ".");
  return first.material + ", " + times(first.log_evidence - next.log_evidence) + " likelier than " +
         next.material + ", the next.";
}

}  // namespace patina
