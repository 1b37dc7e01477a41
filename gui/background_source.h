#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/run/draw_source.h"

namespace patina {

/// A run that is read on a thread of its own, so that frames go on however much there is to read: what
/// take_draws() yields is there already. The thread is one portion ahead, so that a window that is slow to
/// take the draws in never has to take in many at once.
class BackgroundSource final : public DrawSource {
 public:
  /// @param source  one that cannot be controlled, for nobody calls it but the thread
  /// @param wake    called from the thread when there is something new; may be empty
  BackgroundSource(std::unique_ptr<DrawSource> source, std::function<void()> wake);
  ~BackgroundSource() override;  ///< waits for the portion that is being read

  const std::filesystem::path& directory() const override { return source_->directory(); }
  const RunSettings& settings() const override { return settings_; }
  const ParameterTable& table() const override { return table_; }
  const Image& photo() const override { return source_->photo(); }

  std::vector<Draw> take_draws() override;  ///< @throws what the source threw, once
  RunStatus status() const override { return status_; }

  bool can_control() const override { return false; }
  void pause() override {}
  void resume() override {}
  void stop() override {}

 private:
  /// What the thread hands over.
  struct News {
    std::vector<Draw> draws;
    RunStatus status;
    RunSettings settings;  ///< a run that another program goes on with may be asked for more draws
    std::exception_ptr error;
  };
  void read(const std::stop_token& stop);
  News next_news();

  std::unique_ptr<DrawSource> source_;
  std::function<void()> wake_;
  const ParameterTable table_;
  RunSettings settings_;  ///< as of the news that were taken last
  RunStatus status_;
  std::mutex mutex_;
  std::condition_variable_any taken_;
  std::optional<News> news_;  ///< guarded by mutex_
  std::jthread thread_;       // last: joins before what it uses goes
};

/// Opens a run directory to read in the background. @throws UserError as open_run() does
std::unique_ptr<DrawSource> open_in_background(const std::filesystem::path& directory,
                                               std::function<void()> wake);

}  // namespace patina
