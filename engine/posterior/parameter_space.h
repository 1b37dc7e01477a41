#pragma once

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/posterior/prior_transform.h"
#include "engine/sampling/log_density.h"

namespace patina {

/// Which of a material's parameters are free, and the way between their values and sampling coordinates.
/// Free continuous parameters become prior-CDF coordinates; free discrete ones keep their levels; fixed
/// ones are filled in.
class ParameterSpace {
 public:
  /// @param priors  replace the table's, by name   @param fixed  held values, by name (discrete: level index)
  /// @throws UserError for an unknown name, an impossible prior, a fixed value out of range
  ParameterSpace(ParameterTable table, const std::map<std::string, TruncatedNormal>& priors,
                 const std::map<std::string, double>& fixed);

  const ParameterTable& table() const { return table_; }  ///< with the priors in force
  Eigen::Index dimension() const { return static_cast<Eigen::Index>(free_.size()); }
  std::vector<int> discrete_levels() const;
  std::vector<bool> jagged() const;                               ///< of the free continuous ones
  const std::vector<std::size_t>& free() const { return free_; }  ///< their indices into table().continuous

  ParameterValues values(const Position& position) const;
  Position position(const ParameterValues& values) const;

  /// The gradient with respect to the coordinates of a function whose gradient with respect to all of the
  /// table's continuous values is given.
  Eigen::VectorXd pull_back(const Position& position,
                            const Eigen::Ref<const Eigen::VectorXd>& by_value) const;

 private:
  ParameterTable table_;
  ParameterValues held_;           ///< fixed values; free entries are overwritten
  std::vector<std::size_t> free_;  ///< indices into table_.continuous
  std::vector<std::size_t> free_discrete_;
  std::vector<PriorTransform> transforms_;  ///< one per free continuous parameter
};

}  // namespace patina
