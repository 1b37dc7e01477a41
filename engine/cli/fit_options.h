#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/cli/arguments.h"
#include "engine/comparison/rank_materials.h"
#include "engine/run/run_settings.h"

namespace CLI {
class App;
}

namespace patina {

/// What the command line of `patina-cli fit` says.
class FitOptions {
 public:
  /// Adds all options to the command; they must outlive its parsing.
  void add_to(CLI::App& command);

  /// The run that is asked for: the defaults, or with --resume and a run in --out the settings of that run,
  /// and over them what was given. @throws UserError
  /// @param chosen  the material that --material auto came to; without it, that remains the material
  RunSettings settings(const std::string& chosen = {}) const;

  /// What --material auto ranks materials by.
  RankSettings rank_settings() const;

  /// The part of the photo: the one that was given, or with --resume that of the run.
  std::optional<PhotoCrop> crop() const;

  std::filesystem::path photo, out;
  bool resume = false, quiet = false, json = false;

 private:
  bool goes_on() const;  ///< with a run that is there
  /// The settings of the run that --freeze names, with what its photo does not need or pin down held.
  RunSettings frozen_settings() const;
  template <typename T>
  void add(CLI::App& command, const std::string& names, T RunSettings::*setting, const std::string& help,
           const std::string& type = {});
  void add_counts(CLI::App& command);
  void add_stop_rules(CLI::App& command);
  void set_start(RunSettings& settings) const;
  void add_sampler(CLI::App& command);
  void add_model(CLI::App& command);

  RunSettings parsed_;
  CaptureArguments capture_;
  std::string start_, crop_;
  std::filesystem::path freeze_;  ///< a run directory; empty: not given
  bool picture_ = false;
  std::vector<std::string> fixed_, priors_;
  std::vector<std::function<void(RunSettings&)>> given_;  ///< each copies one setting if it was given
};

}  // namespace patina
