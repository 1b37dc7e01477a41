#include "engine/run/version.h"

namespace patina {

std::string program_version() { return "patina " PATINA_VERSION; }

}  // namespace patina
