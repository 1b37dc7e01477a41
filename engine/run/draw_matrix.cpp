#include "engine/run/draw_matrix.h"

#include <algorithm>

#include "engine/posterior/prior_transform.h"

namespace patina {

DrawsByChain by_chain(const std::vector<Draw>& draws) {
  DrawsByChain chains;
  for (const Draw& draw : draws) {
    if (draw.warmup) continue;
    if (chains.size() <= static_cast<std::size_t>(draw.chain))
      chains.resize(static_cast<std::size_t>(draw.chain) + 1);
    chains[static_cast<std::size_t>(draw.chain)].push_back(&draw);
  }
  return chains;
}

Eigen::MatrixXd matrix_of(DrawsByChain chains, const std::function<double(const Draw&)>& quantity) {
  std::erase_if(chains, [](const auto& chain) { return chain.empty(); });
  if (chains.empty()) return {};
  const std::size_t length = std::ranges::min_element(chains, {}, &DrawsByChain::value_type::size)->size();
  Eigen::MatrixXd values(static_cast<Eigen::Index>(length), static_cast<Eigen::Index>(chains.size()));
  for (Eigen::Index k = 0; k < values.cols(); ++k)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      values(i, k) = quantity(*chains[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]);
  return values;
}

std::vector<Eigen::MatrixXd> coordinates_of(const DrawsByChain& chains, const ParameterTable& table) {
  std::vector<Eigen::MatrixXd> coordinates;
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    const PriorTransform transform(table.continuous[i].prior);
    coordinates.push_back(
        matrix_of(chains, [&](const Draw& draw) { return transform.coordinate(draw.values.continuous[i]); }));
  }
  return coordinates;
}

}  // namespace patina
