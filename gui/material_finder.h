#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "engine/comparison/rank_materials.h"
#include "gui/background_loader.h"

namespace patina {

/// Finds out which material a photo shows, on a thread of its own: tens of seconds, told while they pass.
class MaterialFinder {
 public:
  using Rank = decltype(std::function(rank_materials));

  /// @param wake  called from other threads when progress() or take() would tell something new
  MaterialFinder(Rank rank, std::function<void()> wake);
  ~MaterialFinder() { cancel(); }

  void start(std::shared_ptr<const Image> photo, const RankSettings& settings);
  void cancel();
  bool busy() const { return loader_.busy(); }

  struct Progress {
    double fraction = 0;
    std::string doing;  ///< "looking for a match in leather"
  };
  Progress progress() const;

  /// How it ended, once. @throws UserError with the reason where it failed
  std::optional<MaterialRanking> take();

 private:
  /// Written by the thread, read by the window.
  struct Board {
    std::mutex mutex;
    Progress progress;
  };
  struct Request {
    std::shared_ptr<const Image> photo;
    RankSettings settings;
    std::stop_source stop;
    std::shared_ptr<Board> board;
    bool operator==(const Request& other) const { return stop == other.stop; }
  };

  std::shared_ptr<Board> board_;
  std::stop_source stop_;
  BackgroundLoader<Request, std::optional<MaterialRanking>> loader_;
};

}  // namespace patina
