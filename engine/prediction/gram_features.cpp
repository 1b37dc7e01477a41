#include "engine/prediction/gram_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr Eigen::Index kMostCorrelated = 32;  // channels of which all correlations are taken
constexpr float kFaint = 1e-6f;               // of an energy, where Gram matrices have norms about 1

/// How many channels there are, from the size of the upper triangle.
Eigen::Index channels_of(const SummaryBlock& block) {
  return std::llround((std::sqrt(1 + 8.0 * static_cast<double>(block.size)) - 1) / 2);
}

}  // namespace

Eigen::Index gram_features_of(const SummaryBlock& block) {
  const Eigen::Index channels = channels_of(block);
  return channels <= kMostCorrelated ? block.size : channels;
}

void append_gram(const SummaryBlock& block, const float* triangle, std::vector<float>& features) {
  const Eigen::Index channels = channels_of(block);
  std::vector<float> energies;
  for (Eigen::Index i = 0, at = 0; i < channels; at += channels - i, ++i)
    energies.push_back(std::max(triangle[at], 0.0f) + kFaint);
  for (const float energy : energies) features.push_back(std::log(energy));
  if (channels > kMostCorrelated) return;
  for (Eigen::Index i = 0, at = 0; i < channels; ++i, ++at)
    for (Eigen::Index j = i + 1; j < channels; ++j) {
      const float both = energies[static_cast<std::size_t>(i)] * energies[static_cast<std::size_t>(j)];
      features.push_back(triangle[++at] / (std::numbers::sqrt2_v<float> * std::sqrt(both)));
    }
}

}  // namespace patina
