#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/material/parameter.h"
#include "engine/sampling/log_density.h"

namespace patina {

class IrregularityPool;
struct PhotoFit;
struct SimulationSettings;

/// Irregularities to simulate with: for a material that has places a few, dealt anew by where their maps are
/// looked at; else as many as are asked for.
std::shared_ptr<IrregularityPool> make_pool(const ParameterTable& table, std::uint64_t first_seed);

/// What a posterior is made of, beside the photo.
struct PosteriorSettings {
  std::string material = "bump";
  Capture capture;
  int resolution = 192;  ///< pixels a side at which renders are compared
  std::string summary = "gram";
  std::filesystem::path network;  ///< empty: the bundled one
  std::uint64_t z_seed = 1;       ///< fixes the irregularities for the whole run
  // Set by hand, as in the paper, to how far its own fits stay from their 14 photos: on average a relative
  // Gram distance of 0.267 and a mean colour of 6.9 of 255 levels. That is the error of the model, which no
  // parameters remove; much smaller values make a posterior of many separate peaks out of it.
  double gram_sigma = 0.27;  ///< sd of a Gram matrix's error, relative to the photo's Frobenius norm
  double mean_sigma = 0.03;  ///< sd of a regional mean's error, in display units (8 of 255 levels)
  std::map<std::string, double> fixed;  ///< parameters held at a value (discrete ones: a level index)
  std::map<std::string, TruncatedNormal> priors;  ///< priors that replace the material's own
};

/// The posterior of a material's parameters given one photo (paper equation 6), in prior-CDF coordinates:
/// u = Phi^-1(F_prior(theta)), so that the prior is exactly N(0, I) and no Jacobian remains
///   log p(u) = -|u|^2 / 2 - 1/2 sum_k ((S(render(theta(u), z)) - S(photo))_k / sigma_k)^2
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

  /// The summary of the render at a position, each entry over the error's sd: what the photo's is expected to
  /// be, with errors N(0, I).
  Eigen::VectorXd predicted(const Position& position) const;

  /// The posterior given another summary in the photo's place, in the units of predicted(). The errors' sds
  /// stay those of the photo that this posterior was made for, so that predicted() + N(0, I) is a draw from
  /// its sampling distribution to the letter.
  Posterior given(const Eigen::VectorXd& observed) const;

  /// The same posterior with the likelihood that photos simulated of N(centre, covariance) make
  /// (synthetic_likelihood.h), in place of renders and hand-set or other errors: it takes microseconds, has
  /// no jagged coordinates, and leaves places and discrete levels their prior.
  Posterior calibrated_around(const Position& centre, const Eigen::MatrixXd& covariance,
                              const SimulationSettings& settings, IrregularityPool& pool) const;

  /// How the photo compares with those simulated. Null: the errors are the hand-set ones.
  const PhotoFit* fit() const;

  /// All parameters, with the priors in force; fixed ones included.
  const ParameterTable& table() const;

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
