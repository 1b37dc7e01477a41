#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace patina {

/// To stdout, flushed. @throws UserError if it cannot be written (a full disk, a closed pipe)
void print(const std::string& text);

/// One document, indented. Text that is not UTF-8 is mended.
void print(const nlohmann::ordered_json& document);

}  // namespace patina
