#include "engine/material/parameter.h"

#include <algorithm>

namespace patina {
namespace {

template <typename Named>
std::optional<std::size_t> find(const std::vector<Named>& parameters, std::string_view name) {
  const auto found = std::ranges::find(parameters, name, &Named::name);
  if (found == parameters.end()) return std::nullopt;
  return static_cast<std::size_t>(found - parameters.begin());
}

}  // namespace

std::optional<std::size_t> ParameterTable::find_continuous(std::string_view name) const {
  return find(continuous, name);
}
std::optional<std::size_t> ParameterTable::find_discrete(std::string_view name) const {
  return find(discrete, name);
}

ParameterValues prior_location(const ParameterTable& table) {
  ParameterValues values;
  for (const Parameter& parameter : table.continuous)
    values.continuous.push_back(std::clamp(parameter.prior.mean, parameter.prior.low, parameter.prior.high));
  values.discrete.assign(table.discrete.size(), 0);
  return values;
}

}  // namespace patina
