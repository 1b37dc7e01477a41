#include "gui/background_source.h"

#include <chrono>
#include <cstddef>
#include <tuple>
#include <utility>

#include "engine/run/run.h"
#include "gui/words.h"

namespace patina {
namespace {

/// Draws that a window takes in within a frame or two.
constexpr std::size_t kPortion = 40'000;
/// Between two looks at a directory in which nothing is new; a run that is over may still be gone on with.
constexpr std::chrono::milliseconds kLookInterval(200), kLookIntervalAtItsEnd(2000);

}  // namespace

BackgroundSource::BackgroundSource(std::unique_ptr<DrawSource> source, std::function<void()> wake)
    : source_(std::move(source)),
      wake_(std::move(wake)),
      table_(source_->table()),
      settings_(source_->settings()),
      status_(source_->status()),
      thread_([this](const std::stop_token& stop) { read(stop); }) {}

BackgroundSource::~BackgroundSource() = default;

BackgroundSource::News BackgroundSource::next_news() {
  News news;
  try {
    news.draws = source_->take_draws();
    news.status = source_->status();
    news.settings = source_->settings();
  } catch (...) {
    news.error = std::current_exception();
  }
  return news;
}

void BackgroundSource::read(const std::stop_token& stop) {
  RunStatus before;
  while (!stop.stop_requested()) {
    News news = next_news();
    const bool failed = news.error != nullptr, idle = news.draws.empty();
    const auto told = [](const RunStatus& s) { return std::tie(s.phase, s.message, s.read_fraction); };
    const bool changed = told(news.status) != told(before);
    before = news.status;
    std::unique_lock lock(mutex_);
    if (!taken_.wait(lock, stop, [&] { return !news_ || news_->draws.empty(); })) return;
    news_ = std::move(news);
    if (wake_ && (failed || changed || !idle)) wake_();
    if (failed) return;
    const auto interval = is_over(before.phase) ? kLookIntervalAtItsEnd : kLookInterval;
    if (idle) taken_.wait_for(lock, stop, interval, [] { return false; });
  }
}

std::vector<Draw> BackgroundSource::take_draws() {
  std::optional<News> news;
  {
    const std::lock_guard lock(mutex_);
    news = std::exchange(news_, std::nullopt);
  }
  if (!news) return {};
  taken_.notify_one();
  if (news->error) std::rethrow_exception(news->error);
  status_ = std::move(news->status);
  settings_ = std::move(news->settings);
  return std::move(news->draws);
}

std::unique_ptr<DrawSource> open_in_background(const std::filesystem::path& directory,
                                               std::function<void()> wake) {
  return std::make_unique<BackgroundSource>(open_run(directory, kPortion), std::move(wake));
}

}  // namespace patina
