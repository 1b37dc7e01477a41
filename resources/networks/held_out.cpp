#include "resources/networks/held_out.h"

#include <algorithm>
#include <cmath>

#include "engine/material/registry.h"
#include "engine/sampling/rng.h"
#include "resources/networks/recipe.h"

namespace patina {
namespace {

constexpr int kReplicates = 400;

void shuffle(std::vector<Pair>& pairs, Rng& rng) {
  for (std::size_t i = pairs.size(); i > 1; --i)
    std::swap(pairs[i - 1], pairs[static_cast<std::size_t>(rng.below(static_cast<int>(i)))]);
}

/// Moves up to `count` pairs from the end of one list to that of another.
void take(std::vector<Pair>& from, std::size_t count, std::vector<Pair>& to) {
  for (; count > 0 && !from.empty(); --count) {
    to.push_back(from.back());
    from.pop_back();
  }
}

}  // namespace

void LabelledImages::add(const at::Tensor& image, const std::string& material) {
  images.push_back(image);
  materials.push_back(material);
}

LabelledImages held_out_renders(int draws_per_material, int side, std::uint64_t first) {
  std::vector<Recipe> recipes;
  for (const std::string& material : material_names())
    for (int draw = 0; draw < draws_per_material; ++draw) {
      const std::uint64_t seed = first + static_cast<std::uint64_t>(draw);
      Rng rng(seed);
      recipes.push_back(draw_recipe(material, seed + 1, rng));
    }
  LabelledImages result{render_all(recipes, side), {}};
  for (const Recipe& recipe : recipes) result.materials.push_back(recipe.material);
  return result;
}

std::vector<Pair> held_out_pairs(const std::vector<std::string>& materials, std::size_t count,
                                 std::uint64_t seed) {
  std::vector<Pair> alike, others, chosen;
  for (std::size_t i = 0; i < materials.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) (materials[i] == materials[j] ? alike : others).emplace_back(i, j);
  Rng rng(seed);
  shuffle(alike, rng);
  take(alike, count / 2, chosen);
  others.insert(others.end(), alike.begin(), alike.end());
  shuffle(others, rng);
  take(others, count - chosen.size(), chosen);
  return chosen;
}

double bootstrap_error(const std::vector<Pair>& pairs, std::size_t images,
                       const std::function<double(const std::vector<std::size_t>&)>& statistic) {
  Rng rng(/*seed=*/1);
  double sum = 0, square = 0;
  int defined = 0;
  for (int replicate = 0; replicate < kReplicates; ++replicate) {
    std::vector<int> times(images, 0);
    for (std::size_t i = 0; i < images; ++i)
      ++times[static_cast<std::size_t>(rng.below(static_cast<int>(images)))];
    std::vector<std::size_t> drawn;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      drawn.insert(drawn.end(), static_cast<std::size_t>(times[pairs[p].first] * times[pairs[p].second]), p);
    const double value = statistic(drawn);
    if (std::isnan(value)) continue;
    sum += value;
    square += value * value;
    ++defined;
  }
  const double mean = sum / defined;
  return std::sqrt(std::max(0.0, square / defined - mean * mean));
}

}  // namespace patina
