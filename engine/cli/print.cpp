#include "engine/cli/print.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace patina {

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw UserError("The output could not be written: check where it is sent.");
}

void print(const nlohmann::ordered_json& document) {
  print(document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace patina
