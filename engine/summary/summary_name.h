#pragma once

#include <string>
#include <utility>
#include <vector>

namespace patina {

// Names of summaries (summary.h): parts joined by '+', of which those of a network, "gram" and "covariances",
// may end in a number of levels.

/// "gram3", "rings" of "gram3+rings"; an empty one where a '+' stands without a name on each side.
std::vector<std::string> parts_of(const std::string& summary);

/// "gram" and 3 of "gram3"; 0 of a part that has no number.
std::pair<std::string, int> without_levels(const std::string& part);

/// The same summary of the first levels of its network alone: "gram3+rings" of "gram+rings" and 3. What has
/// no network stays as it is. @param levels  from 1 to 9
std::string with_levels(const std::string& summary, int levels);

/// The same without covariances, where Gram matrices stay. Far from a match covariances mislead: a render
/// without any texture is nearer to a photo by them than one with another texture.
std::string without_covariances(const std::string& summary);

}  // namespace patina
