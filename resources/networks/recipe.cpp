#include "resources/networks/recipe.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/prior_transform.h"
#include "engine/summary/image_tensor.h"

namespace patina {

Recipe draw_recipe(const std::string& material, std::uint64_t z_seed, Rng& rng) {
  const ParameterTable table = material_table(material);
  Recipe recipe{material, rng.normals(static_cast<Eigen::Index>(table.continuous.size())), {}, z_seed};
  for (const DiscreteParameter& parameter : table.discrete)
    recipe.levels.push_back(rng.below(static_cast<int>(parameter.levels.size())));
  return recipe;
}

std::vector<at::Tensor> render_all(const std::vector<Recipe>& recipes, int side) {
  const auto surface = [&](std::size_t i) { return std::tie(recipes[i].material, recipes[i].z_seed); };
  std::vector<std::size_t> order(recipes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, surface);
  std::vector<at::Tensor> images(recipes.size());
  std::optional<Renderer> renderer;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Recipe& recipe = recipes[order[k]];
    if (k == 0 || surface(order[k]) != surface(order[k - 1]))
      renderer.emplace(recipe.material, recipe.z_seed, Capture{});
    images[order[k]] =
        to_tensor(renderer->render({values_at(renderer->table(), recipe.coordinates), recipe.levels}, side));
  }
  return images;
}

}  // namespace patina
