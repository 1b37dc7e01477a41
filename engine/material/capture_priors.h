#pragma once

#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

/// A material's parameters with the priors that hold for a photo taken from this distance: those of the
/// table, which are meant for the default camera, times (camera_cm / 25)^camera_power.
///   light, power 2: a camera exposes so that the picture comes out as bright from any distance, while what
///     reaches it from a lamp beside it falls with the square of the distance;
///   iSigma, power 1: the flash's cone is as many degrees wide from any distance.
/// What is returned has camera_power 0: its priors hold as they are.
ParameterTable table_under(ParameterTable table, const Capture& capture);

}  // namespace patina
