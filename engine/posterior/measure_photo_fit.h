#pragma once

#include <Eigen/Core>

#include "engine/posterior/photo_fit.h"

namespace patina {

/// How far a photo is from what its region's photos are on average, where it is thought to be, beside how far
/// they are themselves; entries in units of their errors.
/// @param offsets    coordinates x n   @param summaries  entries x n, of the simulated photos
/// @param photo      the photo's summary   @param offset  where it is thought to be
PhotoFit measure_photo_fit(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& summaries,
                           const Eigen::VectorXd& photo, const Eigen::VectorXd& offset);

}  // namespace patina
