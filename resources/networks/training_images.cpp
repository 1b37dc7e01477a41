#include "resources/networks/training_images.h"

#include <array>
#include <cmath>

#include "engine/material/registry.h"
#include "resources/networks/image_variants.h"
#include "resources/networks/recipe.h"

namespace patina {
namespace {

constexpr int kRenders = 4;   // of a family; the others are made of them
constexpr int kSurfaces = 8;  // irregularities of a material: their maps take a while to make
constexpr double kSmallStep = 0.15, kLargeStep = 0.5;  // prior standard deviations
// Far from the small seeds by which networks are judged (held_out.h) and which a user gives.
constexpr std::uint64_t kFirstSurface = 0x7261'696e'0000;

Recipe step(Recipe recipe, double size, std::uint64_t z_seed, Rng& rng) {
  recipe.coordinates += size * rng.normals(recipe.coordinates.size());
  recipe.z_seed = z_seed;
  return recipe;
}

std::array<Recipe, kRenders> family(const std::string& material, std::uint64_t first_surface, Rng& rng) {
  const int here = rng.below(kSurfaces), there = (here + 1 + rng.below(kSurfaces - 1)) % kSurfaces;
  const std::uint64_t z = first_surface + static_cast<std::uint64_t>(here),
                      other_z = first_surface + static_cast<std::uint64_t>(there);
  const Recipe drawn = draw_recipe(material, z, rng);
  return {drawn, step(drawn, 0, other_z, rng), step(drawn, kSmallStep, z, rng),
          step(drawn, kLargeStep, other_z, rng)};
}

}  // namespace

std::vector<at::Tensor> training_images(int families, int side, std::uint64_t seed) {
  std::vector<Recipe> recipes;
  Rng rng(kFirstSurface + seed);
  for (const std::string& material : material_names())
    for (int i = 0; i < families; ++i)
      for (Recipe& recipe : family(material, kFirstSurface + kSurfaces * seed, rng))
        recipes.push_back(std::move(recipe));
  const std::vector<at::Tensor> renders = render_all(recipes, side);
  const auto any = [&] {
    return renders[static_cast<std::size_t>(rng.below(static_cast<int>(renders.size())))];
  };
  std::vector<at::Tensor> images;
  for (std::size_t first = 0; first < renders.size(); first += kRenders) {
    for (std::size_t i = 0; i < kRenders; ++i) images.push_back(renders[first + i]);
    images.push_back(vary(renders[first + 1], any(), rng));
    at::Tensor varied = renders[first];
    for (int i = 0; i < 3; ++i) varied = vary(varied, any(), rng);
    images.push_back(varied);
  }
  return images;
}

}  // namespace patina
