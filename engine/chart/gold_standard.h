#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/chart/trial.h"
#include "engine/chart/wasserstein.h"

namespace patina {

/// How a gold standard is drawn: by each of some settings in turn, which should have little in common.
struct GoldPlan {
  std::vector<ChartSetting> settings;
  TrialPlan trial;  ///< of each; its seed must be no other trial's
};

/// The default, and MALA in a dense metric with two thirds of the default's refresh moves, both of the target
/// itself: by hand-set errors.
std::vector<ChartSetting> gold_settings(const ChartSetting& usual);

/// A quantity in the gold standard.
struct GoldQuantity {
  std::string name;
  Eigen::MatrixXd draws;  ///< draws x chains, those of one setting after those of another
  double mean = 0, sd = 0, mcse_mean = 0, mcse_sd = 0;
  double bulk_ess = 0, rhat = 0;  ///< NaN for a discrete one that never changes
};

/// Draws from the target that settings are judged by: long, and of two kernels that agree. Whether they do
/// is for the reader to see.
class GoldStandard {
 public:
  /// @param draws  of the settings, chains beside each other   @param names  continuous, then discrete
  GoldStandard(const QuantityDraws& draws, const std::vector<std::string>& names);

  const std::vector<GoldQuantity>& continuous() const { return continuous_; }
  const std::vector<GoldQuantity>& discrete() const { return discrete_; }
  /// Of continuous quantities, one each.
  const std::vector<BlockedSample>& samples() const { return samples_; }
  /// BlockedSample::distance_to_law() of each.
  const std::vector<double>& distances_to_law() const { return distances_to_law_; }
  QuantityDraws draws() const;

  const GoldQuantity& least_converged() const;  ///< of largest R-hat
  const GoldQuantity& least_effective() const;

  /// Whether R-hat over both kernels is at most 1.01 for every quantity (Vehtari et al. 2021).
  bool is_gold() const;

 private:
  std::vector<const GoldQuantity*> judged() const;

  std::vector<GoldQuantity> continuous_, discrete_;
  std::vector<BlockedSample> samples_;
  std::vector<double> distances_to_law_;
};

/// Draws it. Chains are thinned evenly to the shortest, and to 4000 draws each.
/// @throws UserError if a setting made no draws in its time
QuantityDraws draw_gold(const ChartProblem& problem, const GoldPlan& plan);

/// Writes it into a folder: gold.csv, draws of all quantities, with what it was made for and how before them.
void write_gold(const std::filesystem::path& folder, const QuantityDraws& draws,
                const std::vector<std::string>& names, const std::vector<double>& fingerprint,
                const GoldPlan& plan);

/// Reads it, if it is there and was made for that target in that way; else nothing.
std::optional<QuantityDraws> read_gold(const std::filesystem::path& folder,
                                       const std::vector<std::string>& names,
                                       const std::vector<double>& fingerprint, const GoldPlan& plan);

}  // namespace patina
