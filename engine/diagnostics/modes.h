#pragma once

#include <Eigen/Core>
#include <vector>

namespace patina {

/// A kind of solution: draws that agree in every discrete choice and lie in one cloud.
struct Mode {
  std::vector<Eigen::Index> members;  ///< rows, rising
};

/// The modes of a sample, the one with most members first: for each combination of discrete choices the
/// clouds that its draws fall into. A cloud is cut in two where its draws, seen along some direction, thin
/// out to less than a quarter of what there is on either side, with at least a twentieth of the cloud beyond
/// the gap (two equal normal clouds count as separate from 4.2 standard deviations on). Directions are the
/// coordinates, the principal ones, and the one from centre to centre of two halves (as in projected dip
/// tests; Kalogeratos & Likas 2012). A ridge, bent or not, is one cloud. Draws of groups with less than 2 %
/// of the sample, or fewer than 30 members, belong to no mode.
/// @param continuous  a draw a row  @param discrete  likewise; may have no columns
std::vector<Mode> find_modes(const Eigen::MatrixXd& continuous, const Eigen::MatrixXi& discrete);

}  // namespace patina
