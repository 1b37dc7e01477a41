#pragma once

#include <Eigen/Core>

#include <vector>

namespace patina {

/// What holding some quantities at values would do to the others, as far as their joint distribution is
/// normal.
struct Conditioning {
  Eigen::VectorXd shift;      ///< of each other quantity's mean, in its standard deviations
  Eigen::VectorXd narrowing;  ///< of each other's sd: what is left of it, in [0, 1]
};

/// The normal distribution of the others given the held ones (Anderson 2003, "An Introduction to Multivariate
/// Statistical Analysis", theorem 2.5.1), from draws of all.
/// @param draws   draws x quantities
/// @param held    columns, each once; those that never change hold nothing
/// @param values  that they are held at
/// @return        an entry for every column; 0 and 1 for the held ones and those that never change
Conditioning condition(const Eigen::MatrixXd& draws, const std::vector<Eigen::Index>& held,
                       const Eigen::VectorXd& values);

}  // namespace patina
