#pragma once

#include <string>

namespace patina {

/// "patina 0.1.0"
std::string program_version();

}  // namespace patina
