#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/photo.h"
#include "engine/posterior/photo_fit.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"
#include "engine/run/stop_rules.h"

namespace patina {

/// The mode that a run's search found.
struct MapPoint {
  ParameterValues values;
  double lp = 0;
};

/// Seconds that a run has taken, added up over all the times that it was taken up again.
struct RunTimes {
  double search = 0;
  std::vector<double> warmup, sampling;  ///< by chain
};

/// All that run.json holds: what a run was asked to do, to repeat it, and how far it got.
struct Manifest {
  std::string program;  ///< "patina 0.1.0", the version that made the run
  RunSettings settings;
  ParameterTable table;  ///< with the priors in force

  std::string photo_sha256;  ///< of the file that was given
  int photo_width = 0;       ///< of that file, upright, before the crop
  int photo_height = 0;
  std::optional<PhotoCrop> crop;  ///< of that photo; none: the central square
  std::vector<std::string> photo_warnings;
  std::string network_sha256;  ///< of the weights file in force, the bundled one included
  double gram_sigma = 0;       ///< of the error model: PosteriorSettings
  double mean_sigma = 0;

  RunPhase phase = RunPhase::starting;  ///< starting, searching, sampling (warm-up included) or how it ended
  std::string reason;                   ///< one sentence, once it ended
  std::string kernel;                   ///< that draws; empty before there are chains
  std::string errors;         ///< in force, of error_names() without "auto"; empty before they are known
  std::optional<int> warmup;  ///< iterations of each chain, likewise
  std::optional<PhotoFit> photo_fit;  ///< of calibrated errors, once they are
  std::optional<MapPoint> map;
  std::optional<MapPoint> so_far;  ///< the best that the search has met, as long as there is no map
  std::vector<MapPoint> basins;    ///< all that the search ended in, best first; the first is the map
  RunTimes seconds;
  Alarms alarms;                         ///< of the photo and its best match, see run_alarms()
  std::optional<StopEvidence> evidence;  ///< of the last judgement, where stop rules ask for quality
};

constexpr int kRunFormat = 1;  ///< grows whenever an older program would misread the directory

std::string to_json(const Manifest& manifest);

/// Reads run.json. Nothing in it is believed unchecked.
/// @throws UserError for a directory without one, a newer format, or a file that is damaged (which field)
Manifest read_manifest(const std::filesystem::path& directory);

}  // namespace patina
