#pragma once

#include "engine/summary/safetensors.h"
#include "resources/predictors/dense_student.h"

namespace patina {

/// A file that MaterialChooser::load() reads.
SafeTensors chooser_file(const DenseStudent& student);

}  // namespace patina
