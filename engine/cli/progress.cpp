#include "engine/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace patina {
namespace {

constexpr int kBarWidth = 30;

std::int64_t transitions(const RunStatus& status) {
  std::int64_t made = 0;
  for (const ChainStatus& chain : status.chains) made += chain.iteration;
  return made;
}

std::int64_t warmup_transitions(const RunSettings& settings) {
  return std::int64_t{settings.chains} * settings.warmup.value();
}

std::int64_t draws_to_make(const RunSettings& settings) {
  return std::int64_t{settings.chains} * settings.draws;
}

double share(double part, double whole) { return whole > 0 ? std::min(part / whole, 1.0) : 0; }

std::string duration_text(double seconds) {
  const auto whole = std::llround(std::max(seconds, 0.0));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

bool is_drawing(RunPhase phase) { return phase == RunPhase::warming_up || phase == RunPhase::sampling; }

}  // namespace

double progress_fraction(const RunSettings& settings, const RunStatus& status, double elapsed) {
  if (!is_drawing(status.phase)) return status.search_fraction;
  const auto made = static_cast<double>(transitions(status)),
             warmup = static_cast<double>(warmup_transitions(settings));
  if (status.phase == RunPhase::warming_up) return share(made, warmup);
  return std::max(share(made - warmup, static_cast<double>(draws_to_make(settings))),
                  share(elapsed, 60 * settings.stop.minutes));
}

std::string progress_line(const RunSettings& settings, const RunStatus& status, double elapsed) {
  if (!is_drawing(status.phase)) return status.message;
  const std::int64_t draws = transitions(status) - warmup_transitions(settings);
  std::string text = status.message + ", ";
  if (status.phase == RunPhase::warming_up)
    text += std::to_string(std::lround(100 * progress_fraction(settings, status, elapsed))) + " %";
  else
    text += std::to_string(std::max<std::int64_t>(draws, 0)) + " so far";
  if (status.draws_per_second <= 0) return text;
  double left = static_cast<double>(draws_to_make(settings) - draws) / status.draws_per_second;
  if (settings.stop.minutes > 0) left = std::min(left, 60 * settings.stop.minutes - elapsed);
  return text + ", " + std::to_string(std::lround(status.draws_per_second)) + " a second, " +
         (settings.stop.ask_for_quality() ? "at most " : "about ") + duration_text(left) + " left";
}

Progress::Progress(const RunSettings& settings, bool quiet)
    : settings_(settings), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0) {}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Progress::show(const RunStatus& status) {
  const bool new_phase = status.phase != last_phase_;
  last_phase_ = status.phase;
  if (status.phase == RunPhase::paused) {
    if (new_phase) line(status.message + " The run goes on by itself; Ctrl-C ends it.");
    return;
  }
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  if (terminal_) return redraw(status);
  if (!new_phase && now < next_) return;
  next_ = now + std::chrono::seconds(10);
  line(progress_line(in_force(settings_, status), status, elapsed()));
}

void Progress::redraw(const RunStatus& status) {
  const auto filled = static_cast<int>(
      std::lround(kBarWidth * progress_fraction(in_force(settings_, status), status, elapsed())));
  std::string bar(static_cast<std::size_t>(std::clamp(filled, 0, kBarWidth)), '#');
  bar.resize(kBarWidth, '.');
  // Carriage return, then erase to the end of the line.
  std::fprintf(stderr, "\r[%s] %s\033[K", bar.c_str(),
               progress_line(in_force(settings_, status), status, elapsed()).c_str());
  bar_is_drawn_ = true;
}

void Progress::line(const std::string& text) {
  std::fprintf(stderr, bar_is_drawn_ ? "\r%s\033[K\n" : "%s\n", text.c_str());
  bar_is_drawn_ = false;
}

void Progress::end(const RunStatus& status) {
  if (!quiet_) line(status.message);
}

}  // namespace patina
