#pragma once

#include <string>
#include <string_view>

#include "engine/run/run_status.h"

namespace patina {

/// A parameter's name as an artist reads it: "albedo_r" is "Base colour red". Names that the list of known
/// words does not hold are shown as they are, capitalised and with spaces for underscores.
std::string parameter_label(std::string_view name);

/// A material's or level's name for the eye: capitalised, spaces for underscores.
std::string capitalised(std::string_view name);

/// A clause as a sentence begins: its first letter capital, the rest as it is.
std::string sentence(std::string_view clause);

/// A number with so many significant digits, without an exponent where it reads well; a dash if it is not
/// finite.
std::string number_text(double value, int significant = 3);

/// A mean and its spread to two digits of the spread: "0.400 ± 0.030"; the mean alone where there is no
/// spread.
std::string mean_sd_text(double mean, double sd);

/// A count with thin groups of three: "12 400".
std::string count_text(long long count);

/// What a run is doing, in two or three words: "Drawing samples".
std::string phase_text(RunPhase phase);

/// Whether the run can still yield draws without being told to.
bool is_active(RunPhase phase);

/// Whether the run has ended, one way or another.
bool is_over(RunPhase phase);

}  // namespace patina
