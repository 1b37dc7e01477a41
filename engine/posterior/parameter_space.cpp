#include "engine/posterior/parameter_space.h"

#include <cassert>

#include "engine/error.h"
#include "engine/io/params_json.h"

namespace patina {

ParameterSpace::ParameterSpace(ParameterTable table, const std::map<std::string, TruncatedNormal>& priors,
                               const std::map<std::string, double>& fixed)
    : table_(std::move(table)) {
  for (const auto& [name, prior] : priors) {
    const auto index = table_.find_continuous(name);
    if (!index)
      throw UserError("There is no continuous parameter '" + name + "' in " + table_.material +
                      " to give a prior to: see 'patina-cli materials " + table_.material + "'.");
    table_.continuous[*index].prior = prior;
  }
  held_ = prior_location(table_);
  for (const auto& [name, value] : fixed) set_parameter(table_, name, value, held_);
  for (std::size_t i = 0; i < table_.continuous.size(); ++i) {
    const Parameter& parameter = table_.continuous[i];
    const PriorTransform transform(parameter.prior);
    if (fixed.contains(parameter.name)) continue;
    free_.push_back(i);
    transforms_.push_back(transform);
  }
  for (std::size_t i = 0; i < table_.discrete.size(); ++i)
    if (!fixed.contains(table_.discrete[i].name)) free_discrete_.push_back(i);
}

std::vector<int> ParameterSpace::discrete_levels() const {
  std::vector<int> levels;
  for (const std::size_t i : free_discrete_)
    levels.push_back(static_cast<int>(table_.discrete[i].levels.size()));
  return levels;
}

std::vector<bool> ParameterSpace::jagged() const {
  std::vector<bool> jagged;
  for (const std::size_t i : free_) jagged.push_back(table_.continuous[i].jagged);
  return jagged;
}

ParameterValues ParameterSpace::values(const Position& position) const {
  assert(position.continuous.size() == dimension());
  assert(position.discrete.size() == static_cast<Eigen::Index>(free_discrete_.size()));
  ParameterValues values = held_;
  for (std::size_t i = 0; i < free_.size(); ++i)
    values.continuous[free_[i]] = transforms_[i].value(position.continuous[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = 0; i < free_discrete_.size(); ++i)
    values.discrete[free_discrete_[i]] = position.discrete[static_cast<Eigen::Index>(i)];
  return values;
}

Position ParameterSpace::position(const ParameterValues& values) const {
  assert(values.continuous.size() == table_.continuous.size() &&
         values.discrete.size() == table_.discrete.size());
  Position position;
  position.continuous.resize(dimension());
  position.discrete.resize(static_cast<Eigen::Index>(free_discrete_.size()));
  for (std::size_t i = 0; i < free_.size(); ++i)
    position.continuous[static_cast<Eigen::Index>(i)] =
        transforms_[i].coordinate(values.continuous[free_[i]]);
  for (std::size_t i = 0; i < free_discrete_.size(); ++i)
    position.discrete[static_cast<Eigen::Index>(i)] = values.discrete[free_discrete_[i]];
  return position;
}

Eigen::VectorXd ParameterSpace::pull_back(const Position& position,
                                          const Eigen::Ref<const Eigen::VectorXd>& by_value) const {
  Eigen::VectorXd gradient(dimension());
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    gradient[i] =
        by_value[static_cast<Eigen::Index>(free_[k])] * transforms_[k].derivative(position.continuous[i]);
  }
  return gradient;
}

}  // namespace patina
