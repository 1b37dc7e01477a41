#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/io/photo.h"
#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace patina {

/// "light=1500" as ("light", 1500). @throws UserError, naming the option
std::pair<std::string, double> parse_assignment(const std::string& option, const std::string& text);

/// "rough=0.4,0.1,0.2,0.6" (mean, sd, low, high). @throws UserError
std::pair<std::string, TruncatedNormal> parse_prior(const std::string& text);

/// "300,120,800" (x, y and side in pixels of the upright photo). @throws UserError
PhotoCrop parse_crop(const std::string& text);

/// A check for CLI11: empty for a whole number from 0 to 2^64 - 1, else what is wrong. CLI11 itself would
/// take -1 for the largest seed.
std::string seed_problem(const std::string& text);

/// --size-cm and --camera-cm. Without --camera-cm the field of view stays the default one.
struct CaptureArguments {
  double size_cm = Capture{}.size_cm;
  double camera_cm = 0;  ///< 0: not given

  void add_to(CLI::App& command);
  bool given() const;       ///< either of them
  Capture capture() const;  ///< @throws UserError for a length that cannot be

 private:
  std::vector<CLI::Option*> options_;
};

/// As --material of fit: the one that a comparison prefers.
constexpr const char* kAutomatic = "auto";

/// --material. @throws UserError if it is empty or "auto", which fit alone knows; says what there is
void check_material_argument(const std::string& material);

}  // namespace patina
