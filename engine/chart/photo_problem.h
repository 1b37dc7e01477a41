#pragma once

#include <cstdint>
#include <string>

#include "engine/chart/problem.h"
#include "engine/image.h"
#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"

namespace patina {

/// The posterior of a material's parameters given a photo, as a run has it.
class PhotoProblem final : public ChartProblem {
 public:
  /// @param settings     material, capture, summary, network, z_seed and resolution of the target
  /// @param photo        square
  /// @param description  of the photo
  /// @throws UserError as Posterior does
  PhotoProblem(const RunSettings& settings, Image photo, const std::string& description);

  std::string description() const override { return description_; }
  std::vector<std::string> names() const override;
  std::vector<std::unique_ptr<LogDensity>> targets(const ChartSetting& setting) const override;
  Learnt learn(const ChartSetting& setting, std::uint64_t seed,
               const std::function<void()>& simulated) const override;
  std::optional<Averaged> average(const ChartSetting& setting, const std::vector<ChainState>& ends,
                                  std::uint64_t seed, const std::function<void()>& evaluated) const override;
  Emulation emulate(const ChartSetting& setting, const std::vector<ChainState>& starts, const Metric& laplace,
                    std::uint64_t seed, const std::function<void()>& evaluated) const override;
  Emulator emulate_about(const ChartSetting& setting, const Eigen::MatrixXd& places,
                         const KnownResiduals& known, const ChainState& mode, const Metric& laplace,
                         std::uint64_t seed, const std::function<void()>& evaluated) const override;
  std::vector<Eigen::Index> informed() const override;
  Eigen::VectorXd values(const Position& position) const override;
  void use_threads(int count) const override;

  ChartTarget target() const;

 private:
  RunSettings settings_;
  Image photo_;
  std::string description_;
  std::unique_ptr<const Posterior> posterior_;  ///< the target itself
};

/// A photo whose truth is known: a draw from the material's prior, rendered with irregularities of its own.
/// @param seed    of the draw   @param z_seed  of the irregularities; not that of the run
Image photo_of_prior_draw(const RunSettings& settings, std::uint64_t seed, std::uint64_t z_seed);

}  // namespace patina
