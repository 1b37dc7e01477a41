#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "engine/run/preview_worker.h"
#include "gui/preview/shown_draw.h"

namespace patina {

/// Asks for renders of what is shown: at once for a draw that was selected, unhurried for the best draw so
/// far, which a sampler improves many times a second.
class PreviewFeed {
 public:
  /// @param wake  another frame should follow; called from any thread
  explicit PreviewFeed(std::function<void()> wake) : wake_(wake), worker_(std::move(wake)) {}

  /// Asks for what is shown unless it has been asked for already.
  void want(const Session& session, const ShownDraw& shown, int resolution, bool tile = false);

  /// Asks for what may be shown next: a button takes its time from down to up, about as much as a render.
  void foresee(const Session& session, const ShownDraw& next, int resolution, bool tile = false);

  /// The newest render, once; of what was foreseen when it is wanted.
  std::optional<Preview> take();

  bool waiting() const { return asked_ticket() != taken_ticket_ && problem().empty(); }
  std::string problem() const {
    return worker_.error_of(asked_ticket());
  }  ///< of what is wanted, not foreseen

 private:
  using Clock = std::chrono::steady_clock;

  struct Asked {
    PreviewRequest request;
    std::uint64_t ticket = 0;
  };
  static bool is_of(const std::optional<Asked>& asked, const PreviewRequest& request);
  std::uint64_t asked_ticket() const { return asked_ ? asked_->ticket : 0; }
  void ask(PreviewRequest request);

  std::function<void()> wake_;
  PreviewWorker worker_;
  std::optional<Asked> asked_, foreseen_;
  std::optional<Preview> early_;  ///< of what was foreseen
  /// Tickets that are not taken yet; renders of any other were foreseen in vain.
  std::set<std::uint64_t> wanted_;
  std::uint64_t taken_ticket_ = 0;
  Clock::time_point asked_at_;
};

}  // namespace patina
