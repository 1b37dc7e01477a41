#pragma once

#include <optional>
#include <string>
#include <vector>

namespace patina {

/// Why the answer of a run, or a part of it, is not what it seems.
struct Alarm {
  std::string name;  ///< for programs: "noise"
  /// For the user: what was seen, and what to do, with options of patina-cli fit in brackets, "(--chains 4)".
  std::string sentence;
  bool operator==(const Alarm&) const = default;
};

using Alarms = std::vector<Alarm>;

/// The log density of one place is not the same twice. @param noise  nats, see value_noise()
std::optional<Alarm> noise_alarm(double noise);

}  // namespace patina
