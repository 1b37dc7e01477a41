#pragma once

#include <chrono>
#include <string>

#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"

namespace patina {

/// How far a run is, in words: "warming up, 43 %, 212 a second, at most 7 min 40 s left", "drawing samples,
/// 1780 so far, ...". At most, where it ends as soon as its draws are good enough.
/// @param settings  those in force (DrawSource::settings)
/// @param elapsed   seconds of this sitting
std::string progress_line(const RunSettings& settings, const RunStatus& status, double elapsed);

/// The share that is done, 0 to 1: of the search; of warm-up; of the draws or of the time, whichever ends
/// first.
double progress_fraction(const RunSettings& settings, const RunStatus& status, double elapsed);

/// Shows a run's progress on stderr from now on: a bar that is redrawn on a terminal, else a line every ten
/// seconds and at every change of phase. Quiet: only why a run is paused.
class Progress {
 public:
  Progress(const RunSettings& settings, bool quiet);

  void show(const RunStatus& status);
  void end(const RunStatus& status);

 private:
  double elapsed() const;
  void redraw(const RunStatus& status);
  void line(const std::string& text);

  RunSettings settings_;
  bool quiet_, terminal_;
  bool bar_is_drawn_ = false;
  RunPhase last_phase_ = RunPhase::starting;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), next_;
};

}  // namespace patina
