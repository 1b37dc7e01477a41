#pragma once

#include <chrono>
#include <string>

#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"

namespace patina {

/// How far a run is, in words: "drawing samples, 43 %, 212 draws a second, about 12 s left".
std::string progress_line(const RunSettings& settings, const RunStatus& status);

/// The share that is done, 0 to 1: of the search, then of all transitions.
double progress_fraction(const RunSettings& settings, const RunStatus& status);

/// Shows a run's progress on stderr: a bar that is redrawn on a terminal, else a line every ten seconds and
/// at every change of phase. Quiet: only why a run is paused.
class Progress {
 public:
  Progress(const RunSettings& settings, bool quiet);

  void show(const RunStatus& status);
  void end(const RunStatus& status);

 private:
  void redraw(const RunStatus& status);
  void line(const std::string& text);

  RunSettings settings_;
  bool quiet_, terminal_;
  bool bar_is_drawn_ = false;
  RunPhase last_phase_ = RunPhase::starting;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace patina
