#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace patina {

/// A draw that the user starred, by its place in the run, which stays the same while the run grows.
struct Star {
  int chain = 0;
  std::int64_t iteration = 0;
  std::string note;
  bool operator==(const Star&) const = default;
};

/// The stars kept in a run directory (stars.json), in the order in which they were given; none if there is no
/// such file. @throws UserError for a file that is damaged or was written by a newer version
std::vector<Star> read_stars(const std::filesystem::path& directory);

/// Keeps the stars in a run directory, atomically: {"format": 1, "stars": [{"chain", "iteration", "note"}]},
/// chain from 1 as its file is named, iteration from 0. A file that read_stars() refuses is kept as
/// stars.json.damaged. @throws UserError if it cannot be written
void write_stars(const std::filesystem::path& directory, const std::vector<Star>& stars);

}  // namespace patina
