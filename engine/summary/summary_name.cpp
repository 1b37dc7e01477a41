#include "engine/summary/summary_name.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace patina {
namespace {

constexpr std::array<std::string_view, 2> kOfNetwork{"gram", "covariances"};

void append(std::string& summary, const std::string& part) { summary += (summary.empty() ? "" : "+") + part; }

bool has_levels(const std::string& base) { return std::ranges::count(kOfNetwork, base) > 0; }

}  // namespace

std::vector<std::string> parts_of(const std::string& summary) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= summary.size();) {
    const std::size_t end = std::min(summary.find('+', begin), summary.size());
    parts.push_back(summary.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::pair<std::string, int> without_levels(const std::string& part) {
  if (part.empty() || part.back() < '1' || part.back() > '9') return {part, 0};
  const std::string base = part.substr(0, part.size() - 1);
  return has_levels(base) ? std::pair{base, part.back() - '0'} : std::pair{part, 0};
}

std::string without_covariances(const std::string& summary) {
  const std::vector<std::string> parts = parts_of(summary);
  const auto is = [](const char* name) {
    return [name](const std::string& part) { return without_levels(part).first == name; };
  };
  if (std::ranges::none_of(parts, is("gram"))) return summary;
  std::string result;
  for (const std::string& part : parts)
    if (!is("covariances")(part)) append(result, part);
  return result;
}

std::string with_levels(const std::string& summary, int levels) {
  std::string result;
  for (const std::string& part : parts_of(summary)) {
    const std::string base = without_levels(part).first;
    append(result, base + (has_levels(base) ? std::to_string(levels) : ""));
  }
  return result;
}

}  // namespace patina
