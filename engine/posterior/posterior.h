#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/material/parameter.h"
#include "engine/posterior/misfit.h"
#include "engine/sampling/log_density.h"

namespace patina {

class Irregularities;
class Rng;
class RegressedLikelihood;
struct Camera;
struct WiderErrors;

/// What a posterior is made of, beside the photo.
struct PosteriorSettings {
  std::string material = "bump";
  Capture capture;
  int resolution = 192;  ///< pixels a side at which renders are compared
  std::string summary = "gram";
  std::filesystem::path network;      ///< empty: the bundled one
  std::string precision = "float32";  ///< of the network's convolutions (engine/summary/precision.h)
  std::string device = "cpu";         ///< of the network (engine/summary/device.h)
  std::uint64_t z_seed = 1;           ///< fixes the irregularities for the whole run
  // Set by hand, as in the paper: the means' as in its fitting code, the Gram matrices' to how far its own
  // fits stay from their 14 photos, on average a relative distance of 0.267. That is the error of the model,
  // which no parameters remove. A Gram matrix errs along several directions (the participation ratio of its
  // scatter over z is 1.2 to 5.2), so that along each 0.12 to 0.24 of it remain; with 0.15 chains on
  // leather_6 settle in separate peaks (R-hat 1.18), with 0.2 they agree, with 0.27 the priors decide.
  double gram_sigma = 0.2;   ///< sd of a Gram matrix's error, relative to the photo's Frobenius norm
  double mean_sigma = 0.02;  ///< sd of a regional mean's error, in display units (5 of 255 levels)
  std::map<std::string, double> fixed;  ///< parameters held at a value (discrete ones: a level index)
  std::map<std::string, TruncatedNormal> priors;  ///< priors that replace the material's own
};

/// The posterior of a material's parameters given one photo (paper equation 6), in prior-CDF coordinates:
/// u = Phi^-1(F_prior(theta)), so that the prior is exactly N(0, I) and no Jacobian remains
///   log p(u) = -|u|^2 / 2 - 1/2 sum_k ((S(render(theta(u), z)) - S(photo))_k / sigma_k)^2
/// or, where errors are wider along some directions (WiderErrors), with their whole covariance there.
class Posterior final : public LogDensity {
 public:
  /// @param photo  square, 3 channels, sRGB in [0,1]; resampled to settings.resolution
  /// @throws UserError for unknown names, impossible priors, fixed values out of range
  Posterior(const PosteriorSettings& settings, const Image& photo);
  ~Posterior() override;
  Posterior(Posterior&&) noexcept;

  Eigen::Index dimension() const override;
  std::vector<int> discrete_levels() const override;
  std::vector<bool> jagged() const override;

  /// The gradient is zero along jagged coordinates.
  Evaluation evaluate(const Position& position) const override;
  Evaluation value(const Position& position) const override;  ///< without gradient, at half the cost

  /// The same with the whole gradient along every coordinate.
  Evaluation evaluate_with_whole_gradient(const Position& position) const;

  /// The summary of the render at a position, in units of the errors: what the photo's is expected to be,
  /// with errors N(0, I).
  Eigen::VectorXd predicted(const Position& position) const;

  /// The posterior given another summary in the photo's place, in the units of predicted(). The errors' sds
  /// stay those of the photo that this posterior was made for, so that predicted() + N(0, I) is a draw from
  /// its sampling distribution to the letter.
  Posterior given(const Eigen::VectorXd& observed) const;

  /// A summary in the units of predicted(), from its own.
  Eigen::VectorXd in_errors(const Eigen::VectorXd& summary) const;

  /// The photo's summary, in the summary's own units.
  Eigen::VectorXd photo_summary() const;

  /// The sds of the hand-set errors of its entries.
  Eigen::VectorXd hand_set_errors() const;

  /// Which of its entries are second moments.
  std::vector<bool> moments() const;

  /// A photo that a camera takes at a position with other irregularities.
  Image simulated_photo(const Position& position, const Irregularities& z, const Camera& camera,
                        Rng& rng) const;

  /// The summaries of such photos, of one size, in one pass. @return entries x photos
  Eigen::MatrixXd simulated_summaries(std::span<const Image> photos) const;

  /// The same posterior given other irregularities.
  Posterior with(std::shared_ptr<const Irregularities> z) const;

  /// The same posterior with errors that are wider along some directions.
  Posterior with(const WiderErrors& wider) const;

  /// The coordinates that are no places (Parameter::place): what a photo can tell whatever its
  /// irregularities.
  std::vector<Eigen::Index> informed() const;

  /// Those of informed() whose parameters may be negative or positive: along which a material may have a
  /// symmetry (wood's rings open upwards or downwards).
  std::vector<Eigen::Index> of_either_sign() const;

  /// The same posterior with a likelihood that simulations made, of the informed coordinates, in place of
  /// renders and hand-set errors: it takes microseconds, has no jagged coordinates, and leaves places and
  /// discrete levels their prior.
  Posterior with(std::shared_ptr<const RegressedLikelihood> likelihood) const;

  /// The same posterior given one quarter of the photo alone (QuarterSummary), irregularities included.
  /// @param photo  the one that this posterior was made for
  Posterior of_quarter(int quarter, const Image& photo) const;

  /// How far the render at a position is from the photo, part by part of the summary, beside the hand-set
  /// errors.
  std::vector<BlockMisfit> misfit(const Position& position) const;

  /// All parameters, with the priors in force; fixed ones included.
  const ParameterTable& table() const;

  /// The priors of the continuous coordinates: of the parameters that are not fixed.
  std::vector<TruncatedNormal> free_priors() const;

  /// Parameter values in units, fixed ones filled in, from sampling coordinates.
  ParameterValues values(const Position& position) const;

  /// The inverse of values(); fixed parameters are ignored.
  Position position(const ParameterValues& values) const;

 private:
  struct Parts;
  explicit Posterior(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace patina
