#pragma once

#include <chrono>
#include <concepts>
#include <exception>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>

namespace patina {

/// Loads what is asked for on a thread of its own, so that frames go on. The newest request wins; the
/// destructor waits for the one under way.
template <std::equality_comparable Request, typename Loaded>
class BackgroundLoader {
 public:
  struct Outcome {
    Request request;
    std::optional<Loaded> loaded;
    std::string error;  ///< one sentence, where nothing was loaded
  };

  /// @param load  called from the thread
  /// @param wake  called from the thread when take() would find something
  BackgroundLoader(std::function<Loaded(const Request&)> load, std::function<void()> wake)
      : load_(std::move(load)), wake_(std::move(wake)) {}

  /// Does nothing if it is being loaded already.
  void start(Request request) {
    wanted_ = std::move(request);
    if (!running_.valid()) run();
  }
  void cancel() { wanted_.reset(); }

  bool busy() const { return wanted_.has_value(); }
  const Request& request() const { return *wanted_; }  ///< the newest; while busy()

  /// How the newest request ended, once.
  std::optional<Outcome> take() {
    if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    Outcome outcome = running_.get();
    if (wanted_ && outcome.request != *wanted_) run();
    if (!wanted_ || running_.valid()) return std::nullopt;
    wanted_.reset();
    return outcome;
  }

 private:
  void run() {
    running_ = std::async(std::launch::async, [request = *wanted_, load = load_, wake = wake_] {
      Outcome outcome{request, {}, {}};
      try {
        outcome.loaded = load(request);
      } catch (const std::exception& error) {
        outcome.error = error.what();
      }
      if (wake) wake();
      return outcome;
    });
  }

  std::function<Loaded(const Request&)> load_;
  std::function<void()> wake_;
  std::optional<Request> wanted_;
  std::future<Outcome> running_;  ///< of the request wanted, or of one that was
};

}  // namespace patina
