#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/run/preview_worker.h"
#include "gui/gl/surface_renderer.h"
#include "gui/session.h"

namespace patina {

/// Small renders of draws, made one after the other on a thread of their own, and kept.
class Thumbnails {
 public:
  static constexpr int kSmall = 256;         ///< pixels a side; with fewer bumps look smoother than they are
  static constexpr std::size_t kMost = 128;  ///< kept; those that were not looked at for longest go

  /// @param wake  called from the thread when a render is done
  Thumbnails(const Gl& gl, std::function<void()> wake);

  /// A draw's render; null until it is made, which this asks for.
  /// @param hurry  before all that others ask for in this frame
  const Texture* find(const Session& session, std::size_t draw, int resolution = kSmall, bool hurry = false);

  /// Once a frame, after all that may ask: takes in what was made, begins the next.
  void serve();

 private:
  struct Key {
    int run = 0;
    std::size_t draw = 0;
    int resolution = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Entry {
    std::optional<Framebuffer> picture;  ///< none: its render failed
    std::uint64_t used = 0;              ///< the frame when it was looked at last
  };
  void take_in();
  void forget_some();

  const Gl& gl_;
  std::function<void()> wake_;
  std::unique_ptr<PreviewWorker> worker_;    ///< from the first request on
  std::optional<SurfaceRenderer> renderer_;  ///< likewise
  std::map<Key, Entry> entries_;
  std::vector<std::pair<Key, PreviewRequest>> wanted_;  ///< in this frame
  std::optional<Key> pending_;                          ///< what the worker makes
  std::uint64_t ticket_ = 0;                            ///< of what is pending
  std::uint64_t frame_ = 0;
};

}  // namespace patina
