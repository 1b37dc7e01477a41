#include "engine/run/preview_worker.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "engine/material/renderer.h"
#include "engine/run/first_line.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

/// Keeps the renderer of the last request, for the next one is most often of the same material.
class CachedRenderer {
 public:
  void make_maps(Preview& preview) {
    const PreviewRequest& request = preview.request;
    if (!renderer_ || request.material != material_ || request.z_seed != z_seed_ ||
        !(request.capture == capture_)) {
      renderer_.reset();
      renderer_ = std::make_unique<Renderer>(request.material, request.z_seed, request.capture);
      material_ = request.material;
      z_seed_ = request.z_seed;
      capture_ = request.capture;
    }
    preview.repeats = request.tile && renderer_->has_tile();
    preview.maps = preview.repeats ? renderer_->tile(request.values, request.resolution)
                                   : renderer_->maps(request.values, request.resolution);
  }

 private:
  std::unique_ptr<Renderer> renderer_;
  std::string material_;
  std::uint64_t z_seed_ = 0;
  Capture capture_;
};

}  // namespace

struct PreviewWorker::State {
  std::function<void()> wake;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::uint64_t last_ticket = 0;
  std::optional<PreviewRequest> wanted;  ///< with last_ticket
  std::optional<Preview> finished;
  std::uint64_t failed_ticket = 0;
  std::string error;    ///< with failed_ticket
  std::jthread thread;  // last: joins before what it uses goes

  std::optional<Preview> wait_for_request(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    if (!changed.wait(lock, stop, [&] { return wanted.has_value(); })) return std::nullopt;
    Preview preview;
    preview.ticket = last_ticket;
    preview.request = *std::exchange(wanted, std::nullopt);
    return preview;
  }

  void publish(Preview preview) {
    {
      const std::lock_guard lock(mutex);
      finished = std::move(preview);
    }
    if (wake) wake();
  }

  void publish_failure(std::uint64_t ticket, std::string sentence) {
    {
      const std::lock_guard lock(mutex);
      failed_ticket = ticket;
      error = std::move(sentence);
    }
    if (wake) wake();
  }

  void work(const std::stop_token& stop) {
    use_tensor_threads(1);
    CachedRenderer renderer;
    while (auto preview = wait_for_request(stop)) {
      try {
        renderer.make_maps(*preview);
        publish(std::move(*preview));
      } catch (const std::exception& failure) {
        publish_failure(preview->ticket, first_line(failure.what()));
      }
    }
  }
};

PreviewWorker::PreviewWorker(std::function<void()> wake) : state_(std::make_unique<State>()) {
  state_->wake = std::move(wake);
  state_->thread = std::jthread([state = state_.get()](const std::stop_token& stop) { state->work(stop); });
}

PreviewWorker::~PreviewWorker() = default;

std::uint64_t PreviewWorker::request(PreviewRequest request) {
  std::uint64_t ticket = 0;
  {
    const std::lock_guard lock(state_->mutex);
    state_->wanted = std::move(request);
    ticket = ++state_->last_ticket;
  }
  state_->changed.notify_one();
  return ticket;
}

std::optional<Preview> PreviewWorker::take() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->finished, std::nullopt);
}

std::string PreviewWorker::error_of(std::uint64_t ticket) const {
  const std::lock_guard lock(state_->mutex);
  return ticket == state_->failed_ticket ? state_->error : std::string();
}

}  // namespace patina
