#include "engine/run/stop_watcher.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace patina {

StopWatcher::StopWatcher(const RunSettings& settings, const ParameterTable& table,
                         const std::filesystem::path& directory, RunShared& shared)
    : rules_(settings.stop), shared_(shared) {
  if (rules_.ask_for_quality()) monitor_.emplace(rules_, table, directory, settings.chains);
  if (rules_ != StopRules{}) thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

void StopWatcher::watch(const std::stop_token& stop) noexcept {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kInterval(200);
  const Clock::time_point begin = Clock::now();
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  try {
    while (!stop.stop_requested()) {
      if (rules_.minutes > 0 &&
          Clock::now() - begin > std::chrono::duration<double, std::ratio<60>>(rules_.minutes))
        rule_ = "its time is over";
      if (monitor_) monitor_->look();
      if (monitor_ && monitor_->is_safely_reached()) rule_ = "the goal is reached";
      if (!rule_.empty()) return shared_.control.stop();
      never.wait_for(lock, stop, kInterval, [] { return false; });
    }
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
}

StopWatcher::Verdict StopWatcher::end() noexcept {
  thread_ = {};  // asks it to stop and waits
  try {
    if (monitor_ && !monitor_->is_safely_reached()) monitor_->look(/*in_any_case=*/true);
  } catch (const std::exception&) {
    // What cannot be read is not judged; the draws before it are.
  }
  return {std::move(rule_), monitor_ ? monitor_->evidence() : std::nullopt};
}

}  // namespace patina
