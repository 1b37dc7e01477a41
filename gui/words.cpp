#include "gui/words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace patina {
namespace {

using Word = std::pair<std::string_view, std::string_view>;

// Words of models.md for which there is a better one outside the literature.
constexpr std::array<Word, 16> kKnownWords{{
    {"light", "Flash brightness"},
    {"albedo", "Base colour"},
    {"rough", "Roughness"},
    {"rough_var", "Roughness variation"},
    {"fsigma", "Bump frequency"},
    {"fscale", "Bump height"},
    {"iSigma", "Vignette width"},
    {"height", "Height"},
    {"power", "Crease sharpness"},
    {"scale", "Pattern scale"},
    {"noise_scale", "Grain height"},
    {"shift_x", "Pattern shift x"},
    {"shift_y", "Pattern shift y"},
    {"cells", "Cell pattern"},
    {"noise", "Grain pattern"},
    {"slope", "Bump slope"},
}};

constexpr std::array<Word, 3> kColourSuffixes{{{"_r", " red"}, {"_g", " green"}, {"_b", " blue"}}};

std::string known_or_capitalised(std::string_view name) {
  const auto word =
      std::find_if(kKnownWords.begin(), kKnownWords.end(), [&](const Word& w) { return w.first == name; });
  return word != kKnownWords.end() ? std::string(word->second) : capitalised(name);
}

}  // namespace

std::string parameter_label(std::string_view name) {
  for (const auto& [suffix, colour] : kColourSuffixes) {
    if (name.size() > suffix.size() && name.ends_with(suffix)) {
      return known_or_capitalised(name.substr(0, name.size() - suffix.size())).append(colour);
    }
  }
  return known_or_capitalised(name);
}

std::string capitalised(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return sentence(text);
}

std::string sentence(std::string_view clause) {
  std::string text(clause);
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string number_text(double value, int significant) {
  if (!std::isfinite(value)) return "\u2013";
  std::array<char, 64> buffer{};
  const double magnitude = std::abs(value);
  if (magnitude >= 1e6 || (magnitude > 0 && magnitude < 1e-4)) {
    std::snprintf(buffer.data(), buffer.size(), "%.*e", significant - 1, value);
    return buffer.data();
  }
  const int before_point = magnitude >= 1 ? static_cast<int>(std::floor(std::log10(magnitude))) + 1 : 0;
  const int leading_zeros =
      magnitude > 0 && magnitude < 1 ? static_cast<int>(-std::floor(std::log10(magnitude))) - 1 : 0;
  const int decimals = std::max(0, significant - before_point + leading_zeros);
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  std::string text = buffer.data();
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string mean_sd_text(double mean, double sd) {
  if (!std::isfinite(mean) || !std::isfinite(sd) || sd <= 0) return number_text(mean);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(sd))));
  if (decimals > 6 || std::abs(mean) >= 1e6) return number_text(mean) + " \u00b1 " + number_text(sd, 2);
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f \u00b1 %.*f", decimals, mean, decimals, sd);
  return buffer.data();
}

std::string count_text(long long count) {
  std::string digits = std::to_string(count);
  const std::ptrdiff_t first = count < 0 ? 1 : 0;
  for (auto place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > first; place -= 3)
    digits.insert(static_cast<std::size_t>(place), 1, ' ');
  return digits;
}

std::string phase_text(RunPhase phase) {
  switch (phase) {
    case RunPhase::starting:
      return "Getting ready";
    case RunPhase::searching:
      return "Looking for a good match";
    case RunPhase::warming_up:
      return "Warming up";
    case RunPhase::sampling:
      return "Drawing samples";
    case RunPhase::paused:
      return "Paused";
    case RunPhase::finished:
      return "Finished";
    case RunPhase::stopped:
      return "Stopped";
    case RunPhase::failed:
      return "Failed";
  }
  return {};
}

bool is_active(RunPhase phase) { return !is_over(phase) && phase != RunPhase::paused; }

bool is_over(RunPhase phase) {
  return phase == RunPhase::finished || phase == RunPhase::stopped || phase == RunPhase::failed;
}

}  // namespace patina
