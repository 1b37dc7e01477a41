#pragma once

#include <string>

namespace patina {

/// What an exception says, without the stack trace that some libraries put behind it.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace patina
