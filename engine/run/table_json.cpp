#include "engine/run/table_json.h"

#include <nlohmann/json.hpp>

namespace patina {

using Json = nlohmann::ordered_json;

Json prior_json(const TruncatedNormal& prior) {
  return {{"mean", prior.mean}, {"sd", prior.sd}, {"low", prior.low}, {"high", prior.high}};
}

Json table_json(const ParameterTable& table) {
  Json continuous = Json::array(), discrete = Json::array();
  for (const Parameter& parameter : table.continuous)
    continuous.push_back({{"name", parameter.name},
                          {"unit", parameter.unit},
                          {"description", parameter.description},
                          {"prior", prior_json(parameter.prior)}});
  for (const DiscreteParameter& parameter : table.discrete)
    discrete.push_back(
        {{"name", parameter.name}, {"description", parameter.description}, {"levels", parameter.levels}});
  return {{"name", table.material},
          {"description", table.description},
          {"summary", table.summary},
          {"continuous", continuous},
          {"discrete", discrete}};
}

}  // namespace patina
