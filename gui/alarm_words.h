#pragma once

#include <string>

namespace patina {

/// An alarm's sentence as the window says it: what the command line has as an option in brackets is found at
/// one of the window's controls, or else only by `patina-cli fit`.
std::string by_controls(std::string sentence);

}  // namespace patina
