#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/calibration/study.h"

namespace patina {

/// The outcomes of a study as a table, a row a photo; it is complete after every photo.
class OutcomeFile {
 public:
  /// @param study       what decides the outcomes, in words, for a file of another study is refused
  /// @param quantities  CalibrationStudy::quantities()
  /// @throws UserError for a file that is damaged or of another study
  OutcomeFile(std::filesystem::path file, std::string study, std::vector<std::string> quantities);

  /// What a file holds, whatever study that is. @throws UserError for one that is missing or damaged
  static OutcomeFile read(const std::filesystem::path& file);

  const std::string& study() const { return study_; }
  const std::vector<std::string>& quantities() const { return quantities_; }
  const std::vector<PhotoOutcome>& outcomes() const { return outcomes_; }
  bool has(int photo) const;
  void add(PhotoOutcome outcome);  ///< and writes. @throws UserError where that fails

 private:
  std::filesystem::path file_;
  std::string study_;
  std::vector<std::string> quantities_;
  std::vector<PhotoOutcome> outcomes_;  ///< by photo
};

}  // namespace patina
