#pragma once

#include <string>

namespace patina {

/// The processor's name, as the system has it; "unknown processor" where it does not say.
std::string processor_name();

}  // namespace patina
