#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "engine/run/preview_worker.h"
#include "gui/shown_draw.h"

namespace patina {

/// Asks for renders of what is shown: at once for a draw that was selected, unhurried for the best draw so
/// far, which a sampler improves many times a second.
class PreviewFeed {
 public:
  explicit PreviewFeed(std::function<void()> wake) : worker_(std::move(wake)) {}

  /// Asks for what is shown unless it has been asked for already.
  void want(const Session& session, const ShownDraw& shown, int resolution, bool tile = false);

  /// The newest render, once.
  std::optional<Preview> take();

  bool waiting() const { return asked_ticket_ != taken_ticket_ && worker_.last_error().empty(); }
  std::string problem() const { return worker_.last_error(); }

 private:
  using Clock = std::chrono::steady_clock;

  PreviewWorker worker_;
  std::optional<PreviewRequest> asked_;
  std::uint64_t asked_ticket_ = 0, taken_ticket_ = 0;
  Clock::time_point asked_at_;
};

}  // namespace patina
