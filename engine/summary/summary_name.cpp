#include "engine/summary/summary_name.h"

#include <algorithm>
#include <string_view>

namespace patina {
namespace {

constexpr std::string_view kGram = "gram";

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
  const bool counted =
      part.size() == kGram.size() + 1 && part.starts_with(kGram) && part.back() >= '1' && part.back() <= '9';
  return counted ? std::pair{std::string(kGram), part.back() - '0'} : std::pair{part, 0};
}

std::string with_levels(const std::string& summary, int levels) {
  std::string result;
  for (const std::string& part : parts_of(summary)) {
    const std::string base = without_levels(part).first;
    result += (result.empty() ? "" : "+") + base + (base == kGram ? std::to_string(levels) : "");
  }
  return result;
}

}  // namespace patina
