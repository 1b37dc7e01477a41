#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "engine/io/photo.h"
#include "engine/posterior/posterior.h"
#include "engine/run/draw_source.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/manifest.h"
#include "engine/run/match_finder.h"
#include "engine/run/run_lock.h"
#include "engine/run/run_shared.h"
#include "engine/run/warmup_meeting.h"

namespace patina {

enum class Opening { fresh, resumed };

/// A run whose sampler is in this process: a coordinator thread that searches the mode, then one thread a
/// chain. See start_run() and resume_run().
class SamplerRun final : public DrawSource {
 public:
  SamplerRun(const RunSettings& settings, const Photo& photo, const std::filesystem::path& directory,
             std::function<void()> wake, Opening opening);
  ~SamplerRun() override;

  const std::filesystem::path& directory() const override { return directory_; }
  const RunSettings& settings() const override { return settings_; }
  const ParameterTable& table() const override { return table_; }
  const Image& photo() const override { return photo_; }

  std::vector<Draw> take_draws() override { return shared_.draws.take_all(); }
  RunStatus status() const override;

  bool can_control() const override { return true; }
  void pause() override;
  void resume() override;
  void stop() override;

 private:
  void begin();
  void take_up();
  void write_manifest();
  void coordinate() noexcept;
  void run_to_the_end();
  void enter(RunPhase phase, const std::string& message);
  ModeFound find_or_recall();
  void recall();
  const Posterior& posterior() const { return finder_->posterior(); }
  void keep(const MapPoint& best);  ///< in run.json, at intervals, until there is a map
  void note_map(const ModeFound& found);
  void keep(const ModeFound& found);
  ModeFound with_proposals(ModeFound found);  ///< learns what its chains are proposed by, if they are
  void check_is_where_it_was() const;         ///< @throws UserError
  Image finer_render(const Position& position) const;  ///< at more pixels than the run looks at

  void sample(ModeFound found);
  Emulation learnt_about(const ModeFound& found);
  RunSettings as_drawn() const;        ///< with the warm-up in use
  bool learn_again(ModeFound& found);  ///< from warm-up; whether there is anything to
  void conclude(RunPhase phase, const std::string& reason);
  std::string outcome() const;

  std::filesystem::path directory_;
  RunSettings settings_;
  Image photo_;
  ParameterTable table_;
  std::string run_key_;             ///< of the state files
  std::optional<ModeFound> found_;  ///< by a search that was made before the run was taken up again
  WarmupRecord record_;             ///< of meetings that were held before
  Manifest manifest_;  ///< the coordinator's, once it runs, and the search's while it waits for it
  std::chrono::steady_clock::time_point keep_next_;
  std::optional<MatchFinder> finder_;  ///< the coordinator's as well
  std::unique_ptr<RunLock> lock_;
  std::int64_t draws_made_ = 0;  ///< after warm-up, all chains
  RunShared shared_;
  std::thread coordinator_;
};

}  // namespace patina
