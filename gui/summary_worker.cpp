#include "gui/summary_worker.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

#include "engine/error.h"
#include "engine/material/off_values.h"
#include "engine/run/running_summary.h"
#include "gui/priority.h"

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;
constexpr Clock::duration kLeastInterval = std::chrono::milliseconds(100);
constexpr Clock::duration kLeastIntervalOfExactFigures = std::chrono::seconds(1);

/// How long to wait after work that took so long, for a thirtieth of a core: the chains want the rest.
Clock::duration rest_after(Clock::duration spent, Clock::duration least) {
  return std::max(least, 29 * spent);
}

/// The worker's draws after warm-up, thinned by whole iterations so that chains stay aligned.
class ThinnedDraws {
 public:
  void add(std::vector<Draw> arrived) {
    std::copy_if(std::make_move_iterator(arrived.begin()), std::make_move_iterator(arrived.end()),
                 std::back_inserter(draws_), [&](const Draw& draw) { return keeps(draw); });
    // The second condition ends the loop for draws that all claim one iteration.
    while (draws_.size() > SummaryWorker::kMaxDraws && every_ < (std::int64_t{1} << 40)) {
      every_ *= 2;
      std::erase_if(draws_, [&](const Draw& draw) { return !keeps(draw); });
    }
  }

  const std::vector<Draw>& draws() const { return draws_; }
  bool are_all() const { return every_ == 1; }

 private:
  bool keeps(const Draw& draw) const { return !draw.warmup && draw.iteration % every_ == 0; }

  std::vector<Draw> draws_;
  std::int64_t every_ = 1;
};

/// Without the material's file nothing is known to be absent anywhere, and the rest goes on.
std::map<std::string, double> absent_at(const std::string& material) {
  try {
    return off_values(material);
  } catch (const UserError&) {
    return {};
  }
}

}  // namespace

struct SummaryWorker::State {
  ParameterTable table;
  std::function<void()> wake;
  std::mutex mutex;
  std::condition_variable_any arrived;
  std::vector<Draw> inbox;
  std::optional<LiveSummary> outbox;
  std::exception_ptr failure;
  std::jthread thread;  // last: joins before what it uses goes

  std::vector<Draw> wait_for_draws(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    arrived.wait(lock, stop, [&] { return !inbox.empty(); });
    return std::exchange(inbox, {});
  }

  void sleep(const std::stop_token& stop, Clock::duration duration) {
    std::unique_lock lock(mutex);
    arrived.wait_for(lock, stop, duration, [] { return false; });
  }

  void publish(LiveSummary summary) {
    {
      const std::lock_guard lock(mutex);
      outbox = std::move(summary);
    }
    if (wake) wake();
  }

  void publish_failure(std::exception_ptr what) {
    {
      const std::lock_guard lock(mutex);
      failure = std::move(what);
    }
    if (wake) wake();
  }

  void work(const std::stop_token& stop) {
    yield_to_frames();
    ThinnedDraws kept;
    RunningSummary running(table);
    const std::map<std::string, double> off = absent_at(table.material);
    LiveSummary live;  // of the draws that were kept
    auto next_exact = Clock::now();
    while (!stop.stop_requested()) {
      std::vector<Draw> fresh = wait_for_draws(stop);
      for (const Draw& draw : fresh) running.add(draw);
      kept.add(std::move(fresh));
      if (kept.draws().empty()) continue;
      auto start = Clock::now();
      if (start >= next_exact) {
        live = {summarize_draws(table, kept.draws()), advise(table, kept.draws(), off)};
        const auto end = Clock::now();
        next_exact = end + rest_after(end - start, kLeastIntervalOfExactFigures);
        start = end;
      }
      if (!kept.are_all()) running.update(live.summary);
      publish(live);
      const auto end = Clock::now();
      sleep(stop, kept.are_all() ? next_exact - end : rest_after(end - start, kLeastInterval));
    }
  }
};

SummaryWorker::SummaryWorker(ParameterTable table, std::function<void()> wake)
    : state_(std::make_unique<State>()) {
  state_->table = std::move(table);
  state_->wake = std::move(wake);
  state_->thread = std::jthread([state = state_.get()](const std::stop_token& stop) {
    try {
      state->work(stop);
    } catch (...) {
      state->publish_failure(std::current_exception());
    }
  });
}

SummaryWorker::~SummaryWorker() = default;

void SummaryWorker::add(std::vector<Draw> draws) {
  if (draws.empty()) return;
  {
    const std::lock_guard lock(state_->mutex);
    state_->inbox.insert(state_->inbox.end(), std::make_move_iterator(draws.begin()),
                         std::make_move_iterator(draws.end()));
  }
  state_->arrived.notify_one();
}

std::optional<LiveSummary> SummaryWorker::take() {
  const std::lock_guard lock(state_->mutex);
  if (state_->failure) std::rethrow_exception(std::exchange(state_->failure, nullptr));
  return std::exchange(state_->outbox, std::nullopt);
}

}  // namespace patina
