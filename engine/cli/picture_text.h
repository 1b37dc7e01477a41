#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/run/needed_picture.h"

namespace patina {

// How much of the picture a photo needs, for a reader and for a program.

std::string picture_table(const NeededPicture& needed);
nlohmann::ordered_json picture_json(const NeededPicture& needed);

}  // namespace patina
