#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/io/chain_csv.h"
#include "engine/run/chain_tally.h"
#include "engine/run/draw_source.h"
#include "engine/run/manifest.h"
#include "engine/run/rate_meter.h"

namespace patina {

/// A run read from its directory, which another process may still be writing. See open_run(). The files are
/// looked at no more often than five times a second, however often a front end asks, but for what is known to
/// be there.
class RunReader final : public DrawSource {
 public:
  RunReader(const std::filesystem::path& directory, std::size_t portion);

  const std::filesystem::path& directory() const override { return directory_; }
  const RunSettings& settings() const override { return manifest_.settings; }
  const ParameterTable& table() const override { return manifest_.table; }
  const Image& photo() const override { return photo_; }

  /// @throws UserError if a chain file is damaged
  std::vector<Draw> take_draws() override;
  RunStatus status() const override;

  bool can_control() const override { return false; }
  void pause() override {}
  void resume() override {}
  void stop() override {}

 private:
  struct ChainFile {
    std::optional<ChainCsvReader> reader;  ///< once there is a file
    ChainTally tally;
    std::int64_t rows = 0;
  };

  void read_again();  ///< the manifest. @throws UserError for another run's
  void read_chain(int chain, std::vector<Draw>& draws);
  double read_fraction() const;
  void take_in(const Draw& draw);
  RunPhase phase() const;
  std::string message(RunPhase phase) const;
  std::int64_t draws_after_warmup() const;

  std::filesystem::path directory_;
  std::size_t portion_;  ///< of draws, about
  Manifest manifest_;
  Image photo_;
  std::vector<ChainFile> chains_;
  std::optional<MapPoint> best_draw_;
  bool writer_lives_ = false;
  bool more_ = false;       ///< draws than the last portion are there
  bool caught_up_ = false;  ///< with what was there when it was opened
  RateMeter draw_rate_;
  std::optional<RateMeter::Clock::time_point> last_look_;
};

}  // namespace patina
