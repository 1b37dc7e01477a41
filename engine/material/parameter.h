#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

/// A normal distribution N(mean, sd^2) cut to [low, high], in the parameter's own unit.
struct TruncatedNormal {
  double mean = 0;
  double sd = 1;
  double low = 0;
  double high = 1;
  bool operator==(const TruncatedNormal&) const = default;
};

/// A continuous parameter of a material.
struct Parameter {
  std::string name;         ///< as in params JSON: "albedo_r"
  std::string unit;         ///< "cm", "cycles/cm", "degrees" or "" for a plain number
  std::string description;  ///< one line
  TruncatedNormal prior;
  double camera_power = 0;         ///< of the camera's distance, that the prior grows with (capture_priors.h)
  std::optional<double> off = {};  ///< where what it scales is not there (off_values.h)
  bool jagged = false;  ///< where in a random map: a small step is another surface (LogDensity::jagged)
  bool place = false;   ///< jagged, and all its values are alike but for the irregularities that they show
};

/// A discrete parameter: a choice among named levels, all equally likely a priori. Every choice of today's
/// materials is a place, as Parameter has it: one of several maps that are alike but for their
/// irregularities.
struct DiscreteParameter {
  std::string name;
  std::string description;
  std::vector<std::string> levels;
};

/// What a material can be asked for: all its parameters, in the order in which ParameterValues holds them.
struct ParameterTable {
  std::string material;     ///< "leather"
  std::string description;  ///< one line
  std::vector<Parameter> continuous;
  std::vector<DiscreteParameter> discrete;
  std::string summary = "gram";  ///< what its renders are compared by, unless a run says otherwise

  std::optional<std::size_t> find_continuous(std::string_view name) const { return find(continuous, name); }
  std::optional<std::size_t> find_discrete(std::string_view name) const { return find(discrete, name); }

 private:
  template <typename Named>
  static std::optional<std::size_t> find(const std::vector<Named>& parameters, std::string_view name) {
    const auto found = std::ranges::find(parameters, name, &Named::name);
    if (found == parameters.end()) return std::nullopt;
    return static_cast<std::size_t>(found - parameters.begin());
  }
};

/// One point of a material's parameter space, in parameter units; discrete entries are level indices.
struct ParameterValues {
  std::vector<double> continuous;
  std::vector<int> discrete;
  bool operator==(const ParameterValues&) const = default;
};

/// The prior's means (its location, not the truncated mean) and each discrete parameter's first level.
ParameterValues prior_location(const ParameterTable& table);

}  // namespace patina
