#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "engine/io/photo.h"
#include "engine/posterior/posterior.h"
#include "engine/run/draw_source.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_search.h"
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
  std::vector<Position> guesses() const;  ///< where the search looks first
  /// Of the search. One, beside the guess's, where an average is to follow, which is learnt about other
  /// matches of its own accord (emulator_starts()): of four photos' best matches none was the second
  /// finalist's.
  int finalists() const;
  ModeFound search();
  void keep(const MapPoint& best);  ///< in run.json, at intervals, until there is a map
  void note_map(const ModeFound& found);
  void keep(const ModeFound& found);
  ModeFound with_proposals(ModeFound found);  ///< learns what its chains are proposed by, if they are
  void check_is_where_it_was() const;         ///< @throws UserError
  /// The first level of the search's pyramid.
  std::unique_ptr<Posterior> coarsest() const;
  void keep_the_finest();
  ModeFound calibrate();    ///< in place of a search: the photos of the prior that it begins with are one
  Position coarse_match();  ///< the best match by hand-set errors, at the fewest pixels that show it
  void show(const Position& position);
  void use(const CalibratedErrors& errors);
  void use(const WiderErrors& wider);
  bool is_calibrated() const { return settings_.errors == "calibrated"; }
  Image finer_render(const Position& position) const;  ///< at more pixels than the run looks at

  /// Whether over irregularities. Not of itself for a match alone, with no draws to follow: errors that
  /// forgive what irregularities do forgive colours, too (wood_3's are off by 6.1 in place of 2.5,
  /// resources/fits).
  bool averages() const;
  /// What a search ended in by hand-set errors, found again. From its written form, whether it is read or
  /// not: chains of a run that was a match alone before are those of one that was not.
  ModeFound widen(const std::vector<MapPoint>& basins);
  /// That simulated photos, and the renders that an average is learnt from, have.
  IrregularityPool& irregularities();
  void sample(ModeFound found);
  Emulation learnt_about(const ModeFound& found);
  bool learn_again(ModeFound& found);  ///< from warm-up; whether there is anything to
  void conclude(RunPhase phase, const std::string& reason);
  std::string outcome() const;

  std::filesystem::path directory_;
  RunSettings settings_;
  Image photo_;
  ParameterTable table_;
  bool emulates_ = false;           ///< whether its chains' proposals are to be emulated
  std::string run_key_;             ///< of the state files
  std::optional<ModeFound> found_;  ///< by a search that was made before the run was taken up again
  WarmupRecord record_;             ///< of meetings that were held before
  Manifest manifest_;  ///< the coordinator's, once it runs, and the search's while it waits for it
  std::chrono::steady_clock::time_point keep_next_;
  std::vector<std::unique_ptr<Posterior>> posteriors_;  ///< coarse to fine; the coordinator's as well
  std::shared_ptr<IrregularityPool> pool_;              ///< see irregularities()
  std::unique_ptr<RunLock> lock_;
  std::int64_t draws_made_ = 0;  ///< after warm-up, all chains
  RunShared shared_;
  std::thread coordinator_;
};

}  // namespace patina
