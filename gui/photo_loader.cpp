#include "gui/photo_loader.h"

#include <chrono>
#include <exception>
#include <utility>

namespace patina {

void PhotoLoader::start(Request request) {
  if (busy() && request == request_) return;
  outdated_ = busy();
  request_ = std::move(request);
  if (!outdated_) run();
}

void PhotoLoader::run() {
  running_ = std::async(std::launch::async, [request = request_, wake = wake_] {
    Outcome outcome{request, {}, {}};
    try {
      outcome.photo = load_photo(request.file, {.crop = request.crop, .whole_side = kWholeSide});
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    if (wake) wake();
    return outcome;
  });
}

std::optional<PhotoLoader::Outcome> PhotoLoader::take() {
  if (!busy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  Outcome outcome = running_.get();
  if (!std::exchange(outdated_, false)) return outcome;
  run();
  return std::nullopt;
}

}  // namespace patina
