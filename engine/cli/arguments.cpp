#include "engine/cli/arguments.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/run/run_checks.h"

namespace patina {
namespace {

bool parse_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

std::string seed_problem(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error == std::errc{} && end == text.data() + text.size()) return {};
  return "'" + text + "' is not a whole number from 0 to 18446744073709551615";
}

std::pair<std::string, double> parse_assignment(const std::string& option, const std::string& text) {
  const auto equals = text.find('=');
  double value = 0;
  if (equals == std::string::npos || equals == 0 || !parse_number(text.substr(equals + 1), value))
    throw UserError("'" + option + " " + text + "' is not understood: write " + option +
                    " NAME=NUMBER, for example " + option + " rough=0.4.");
  return {text.substr(0, equals), value};
}

std::pair<std::string, TruncatedNormal> parse_prior(const std::string& text) {
  const auto equals = text.find('=');
  std::vector<double> numbers;
  bool good = equals != std::string::npos && equals > 0;
  for (std::size_t begin = equals + 1; good && begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    good = parse_number(text.substr(begin, comma - begin), numbers.emplace_back());
    begin = comma + 1;
  }
  if (!good || numbers.size() != 4)
    throw UserError("'--prior " + text +
                    "' is not understood: write --prior NAME=MEAN,SD,LOW,HIGH, for example --prior "
                    "rough=0.4,0.1,0.2,0.6.");
  return {text.substr(0, equals), {numbers[0], numbers[1], numbers[2], numbers[3]}};
}

PhotoCrop parse_crop(const std::string& text) {
  std::array<int, 3> numbers{};
  const char *place = text.data(), *end = text.data() + text.size();
  bool good = true;
  for (std::size_t i = 0; good && i < numbers.size(); ++i) {
    const auto [rest, error] = std::from_chars(place, end, numbers[i]);
    good = error == std::errc{} && (i + 1 < numbers.size() ? rest != end && *rest == ',' : rest == end);
    place = rest + 1;
  }
  if (!good)
    throw UserError("'--crop " + text +
                    "' is not understood: write --crop X,Y,SIDE in pixels, for example --crop 300,120,800.");
  return {numbers[0], numbers[1], numbers[2]};
}

void CaptureArguments::add_to(CLI::App& command) {
  options_ = {command.add_option("--size-cm", size_cm, "Side of the photographed square in cm")
                  ->capture_default_str(),
              command.add_option(
                  "--camera-cm", camera_cm,
                  "Distance of camera and flash in cm (default: the one of a 46 degree field of view)")};
}

bool CaptureArguments::given() const {
  return std::ranges::any_of(options_, [](const CLI::Option* option) { return option->count() > 0; });
}

Capture CaptureArguments::capture() const {
  const Capture standard;
  const double camera = camera_cm != 0 ? camera_cm : standard.camera_cm / standard.size_cm * size_cm;
  const Capture capture{size_cm, camera};
  check_capture(capture);
  return capture;
}

void check_material_argument(const std::string& material) {
  std::string known;
  for (const std::string& name : material_names()) known += (known.empty() ? "" : ", ") + name;
  if (material.empty()) throw UserError("Which material? Add --material NAME: " + known + ".");
  if (material == kAutomatic)
    throw UserError("Only fit chooses the material itself: add --material NAME: " + known + ".");
}

}  // namespace patina
