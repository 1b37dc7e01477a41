#include "gui/fuzzy.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace patina {
namespace {

constexpr int kLetter = 10, kFollows = 12, kBeginsWord = 15;
constexpr int kNever = std::numeric_limits<int>::min() / 2;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool begins_word(std::string_view text, std::size_t place) {
  return place == 0 || !std::isalnum(static_cast<unsigned char>(text[place - 1]));
}

}  // namespace

std::optional<int> fuzzy_score(std::string_view typed, std::string_view text) {
  // best[j]: of the letters so far, the last one matched at j.
  std::vector<int> best(text.size(), kNever), next(text.size());
  bool first = true;
  for (const char letter : typed) {
    if (letter == ' ') continue;
    int before = first ? 0 : kNever;  // the best that ends before j - 1
    for (std::size_t j = 0; j < text.size(); ++j) {
      if (!first && j >= 2) before = std::max(before, best[j - 2]);
      const int follows = !first && j >= 1 ? best[j - 1] + kFollows : kNever;
      const bool same = lower(letter) == lower(text[j]);
      const int from = std::max(before, follows);
      next[j] =
          same && from > kNever / 2 ? from + kLetter + (begins_word(text, j) ? kBeginsWord : 0) : kNever;
    }
    std::swap(best, next);
    first = false;
  }
  if (first) return 0;
  const int score = best.empty() ? kNever : std::ranges::max(best);
  if (score <= kNever / 2) return std::nullopt;
  return score - static_cast<int>(std::min<std::size_t>(text.size(), 99)) / 10;
}

}  // namespace patina
