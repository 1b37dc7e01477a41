#pragma once

#include <optional>
#include <string_view>

namespace patina {

/// How well a text answers what was typed: nothing unless it holds the typed letters in that order, case
/// aside; more the more of them begin words or follow one another, and the shorter the text.
std::optional<int> fuzzy_score(std::string_view typed, std::string_view text);

}  // namespace patina
