#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/io/chain_csv.h"
#include "engine/run/draw.h"
#include "engine/run/stop_rules.h"

namespace patina {

/// Judges a growing run by its chain files, so that what it judges is what is on disk, draws from before the
/// run was taken up again included. Used by one thread at a time.
class StopMonitor {
 public:
  StopMonitor(StopRules rules, ParameterTable table, std::filesystem::path directory, int chains);

  /// Reads what was written since the last look. Judges it if at least a tenth has come since the last
  /// judgement, or `in_any_case`. @throws UserError for a chain file that is damaged
  void look(bool in_any_case = false);

  bool is_safely_reached() const { return evidence_ && patina::is_safely_reached(rules_, *evidence_); }
  const std::optional<StopEvidence>& evidence() const { return evidence_; }

 private:
  struct ChainFile {
    std::optional<ChainCsvReader> reader;  ///< once there is a file
    std::int64_t rows = 0;
  };
  void read(int chain);

  StopRules rules_;
  ParameterTable table_;
  std::filesystem::path directory_;
  std::vector<ChainFile> chains_;
  std::vector<Draw> draws_;  ///< after warm-up
  std::size_t judged_ = 0;   ///< how many of them were there at the last judgement
  std::optional<StopEvidence> evidence_;
};

}  // namespace patina
