#include "engine/posterior/posterior.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/Tensor.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/material/capture_priors.h"
#include "engine/material/material.h"
#include "engine/material/registry.h"
#include "engine/posterior/error_model.h"
#include "engine/posterior/forward_model.h"
#include "engine/posterior/parameter_space.h"
#include "engine/posterior/regressed_likelihood.h"
#include "engine/posterior/whitening.h"
#include "engine/posterior/wider_errors.h"
#include "engine/summary/quarter_summary.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

Eigen::VectorXd to_vector(const at::Tensor& tensor) {
  const at::Tensor doubles = tensor.to(at::kDouble).contiguous();
  return Eigen::Map<const Eigen::VectorXd>(doubles.data_ptr<double>(), doubles.numel());
}

at::Tensor to_tensor(const Eigen::VectorXd& vector) {
  const at::ArrayRef<double> values(vector.data(), static_cast<std::size_t>(vector.size()));
  return at::tensor(values, at::kDouble).to(at::kFloat);
}

Evaluation outside_support(Eigen::Index dimension) {
  return {-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(dimension)};
}

}  // namespace

struct Posterior::Parts {
  PosteriorSettings settings;
  ForwardModel model;
  ParameterSpace space;
  std::shared_ptr<const Irregularities> z;
  at::Tensor photo_summary;
  Whitening whitened{at::Tensor()};
  std::shared_ptr<const RegressedLikelihood> calibrated;  ///< null: the errors are the hand-set ones
  std::vector<Eigen::Index> informed;                     ///< coordinates that it is of

  Parts(const PosteriorSettings& s, const Image& photo)
      : settings(s),
        model(make_material(s.material),
              make_summary(s.summary, s.network, precision_named(s.precision), device_named(s.device)),
              s.capture, s.resolution),
        space(table_under(model.material->table(), s.capture), s.priors, s.fixed),
        z(std::make_shared<const Irregularities>(s.z_seed)) {
    compare_with(photo);
  }

  /// By the model's summary.
  void compare_with(const Image& photo) {
    const int least = model.summary->minimum_resolution();
    if (settings.resolution < least)
      throw UserError("The resolution " + std::to_string(settings.resolution) +
                      " is too small for this summary: use " + std::to_string(least) + " or more.");
    photo_summary = model.summary_of(photo);
    whitened = Whitening(
        inverse_sigmas(photo_summary, model.summary->blocks(), settings.gram_sigma, settings.mean_sigma));
  }

  /// Summary of the render at parameter values, with its graph.
  at::Tensor summary_at(const ParameterTensors& parameters, const std::vector<int>& discrete) const {
    return model.summary_of_render(parameters, discrete, *z);
  }

  /// Under calibrated errors; nothing is rendered.
  Evaluation calibrated_evaluation(const Position& position) const {
    const Evaluation likelihood = calibrated->evaluate(position.continuous(informed));
    Evaluation evaluation{likelihood.log_density - 0.5 * position.continuous.squaredNorm(),
                          -position.continuous};
    evaluation.gradient(informed) += likelihood.gradient;
    return evaluation;
  }

  /// Render minus photo, with its graph.
  at::Tensor difference(const ParameterTensors& parameters, const std::vector<int>& discrete) const {
    return summary_at(parameters, discrete) - photo_summary;
  }

  /// Half the chi-square of the render's summary, a double scalar with its graph.
  at::Tensor misfit(const ParameterTensors& parameters, const std::vector<int>& discrete) const {
    return whitened(difference(parameters, discrete)).to(at::kDouble).square().sum() * 0.5;
  }

  /// Parameter values as leaves of a graph; only those whose gradient is wanted ask for one.
  std::vector<at::Tensor> leaves(const ParameterValues& values, bool jagged_too) const {
    std::vector<at::Tensor> leaves;
    for (const double value : values.continuous) leaves.push_back(at::scalar_tensor(value, at::kFloat));
    for (const std::size_t i : space.free())
      leaves[i].set_requires_grad(jagged_too || !space.table().continuous[i].jagged);
    return leaves;
  }

  Evaluation evaluate(const Position& position, bool along_jagged) const {
    if (!position.continuous.allFinite()) return outside_support(space.dimension());
    if (calibrated) return calibrated_evaluation(position);
    const ParameterValues values = space.values(position);
    const std::vector<at::Tensor> parameters = leaves(values, along_jagged);
    const at::Tensor misfit = this->misfit(parameters, values.discrete);
    if (misfit.requires_grad()) misfit.backward();

    Eigen::VectorXd by_value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (const at::Tensor& gradient = parameters[i].grad(); gradient.defined())
        by_value[static_cast<Eigen::Index>(i)] = gradient.item<double>();
    Evaluation evaluation;
    evaluation.log_density = -0.5 * position.continuous.squaredNorm() - misfit.item<double>();
    evaluation.gradient = -position.continuous - space.pull_back(position, by_value);
    const std::vector<bool> jagged = space.jagged();
    for (std::size_t i = 0; i < jagged.size(); ++i)
      if (jagged[i] && !along_jagged) evaluation.gradient[static_cast<Eigen::Index>(i)] = 0;
    if (!std::isfinite(evaluation.log_density) || !evaluation.gradient.allFinite())
      return outside_support(space.dimension());
    return evaluation;
  }
};

Posterior::Posterior(const PosteriorSettings& settings, const Image& photo)
    : parts_(std::make_unique<Parts>(settings, photo)) {}

Posterior::Posterior(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Posterior::Posterior(Posterior&&) noexcept = default;

Posterior::~Posterior() = default;

Eigen::VectorXd Posterior::predicted(const Position& position) const {
  const at::NoGradGuard no_grad;
  const ParameterValues values = parts_->space.values(position);
  return to_vector(parts_->whitened(parts_->summary_at(parts_->leaves(values, false), values.discrete)));
}

Eigen::VectorXd Posterior::in_errors(const Eigen::VectorXd& summary) const {
  return to_vector(parts_->whitened(to_tensor(summary)));
}

Posterior Posterior::with(std::shared_ptr<const Irregularities> z) const {
  auto parts = std::make_unique<Parts>(*parts_);
  parts->z = std::move(z);
  return Posterior(std::move(parts));
}

Posterior Posterior::with(const WiderErrors& wider) const {
  auto parts = std::make_unique<Parts>(*parts_);
  parts->whitened = parts->whitened.along(wider);
  return Posterior(std::move(parts));
}

std::vector<BlockMisfit> Posterior::misfit(const Position& position) const {
  const at::NoGradGuard no_grad;
  const ParameterValues values = parts_->space.values(position);
  const PosteriorSettings& s = parts_->settings;
  const at::Tensor difference = parts_->difference(parts_->leaves(values, false), values.discrete);
  return block_misfits(difference * parts_->whitened.inverse_sigmas(), parts_->model.summary->blocks(),
                       s.gram_sigma, s.mean_sigma);
}

Posterior Posterior::given(const Eigen::VectorXd& observed) const {
  if (observed.size() != parts_->photo_summary.numel())
    throw std::invalid_argument("an observation has as many entries as a prediction");
  auto parts = std::make_unique<Parts>(*parts_);
  parts->photo_summary = parts->whitened.undo(to_tensor(observed));
  parts->calibrated.reset();
  return Posterior(std::move(parts));
}

Eigen::VectorXd Posterior::photo_summary() const { return to_vector(parts_->photo_summary); }

Eigen::VectorXd Posterior::hand_set_errors() const {
  return to_vector(parts_->whitened.inverse_sigmas()).cwiseInverse();
}

std::vector<bool> Posterior::moments() const {
  std::vector<bool> moments;
  for (const SummaryBlock& block : parts_->model.summary->blocks())
    moments.insert(moments.end(), static_cast<std::size_t>(block.size), block.scale == ErrorScale::relative);
  return moments;
}

Image Posterior::simulated_photo(const Position& position, const Irregularities& z, const Camera& camera,
                                 Rng& rng) const {
  return parts_->model.photo(values(position), z, camera, rng);
}

Eigen::MatrixXd Posterior::simulated_summaries(std::span<const Image> photos) const {
  const auto count = static_cast<Eigen::Index>(photos.size());
  return to_vector(parts_->model.summaries_of_photos(photos)).reshaped(Eigen::AutoSize, count);
}

std::vector<Eigen::Index> Posterior::informed() const {
  std::vector<Eigen::Index> informed;
  const ParameterSpace& space = parts_->space;
  for (std::size_t i = 0; i < space.free().size(); ++i)
    if (!space.table().continuous[space.free()[i]].place) informed.push_back(static_cast<Eigen::Index>(i));
  return informed;
}

std::vector<Eigen::Index> Posterior::of_either_sign() const {
  std::vector<Eigen::Index> coordinates = informed();
  const std::vector<TruncatedNormal> priors = free_priors();
  std::erase_if(coordinates, [&](Eigen::Index i) { return priors[static_cast<std::size_t>(i)].low >= 0; });
  return coordinates;
}

Posterior Posterior::with(std::shared_ptr<const RegressedLikelihood> likelihood) const {
  auto parts = std::make_unique<Parts>(*parts_);
  parts->calibrated = std::move(likelihood);
  parts->informed = informed();
  return Posterior(std::move(parts));
}

Posterior Posterior::of_quarter(int quarter, const Image& photo) const {
  auto parts = std::make_unique<Parts>(*parts_);
  parts->model.summary = std::make_shared<const QuarterSummary>(parts->model.summary, quarter);
  parts->compare_with(photo);
  parts->calibrated.reset();
  return Posterior(std::move(parts));
}

Eigen::Index Posterior::dimension() const { return parts_->space.dimension(); }

std::vector<TruncatedNormal> Posterior::free_priors() const {
  std::vector<TruncatedNormal> priors;
  for (const std::size_t i : parts_->space.free()) priors.push_back(table().continuous[i].prior);
  return priors;
}

std::vector<int> Posterior::discrete_levels() const { return parts_->space.discrete_levels(); }

std::vector<bool> Posterior::jagged() const {
  return parts_->calibrated ? std::vector<bool>{} : parts_->space.jagged();
}

const ParameterTable& Posterior::table() const { return parts_->space.table(); }

ParameterValues Posterior::values(const Position& position) const { return parts_->space.values(position); }

Position Posterior::position(const ParameterValues& values) const { return parts_->space.position(values); }

Evaluation Posterior::evaluate(const Position& position) const { return parts_->evaluate(position, false); }

Evaluation Posterior::value(const Position& position) const {
  if (!position.continuous.allFinite()) return outside_support(dimension());
  if (parts_->calibrated) return parts_->calibrated_evaluation(position);
  const at::NoGradGuard no_grad;
  const ParameterValues values = parts_->space.values(position);
  const at::Tensor misfit = parts_->misfit(parts_->leaves(values, false), values.discrete);
  return {-0.5 * position.continuous.squaredNorm() - misfit.item<double>(), {}};
}

Evaluation Posterior::evaluate_with_whole_gradient(const Position& position) const {
  return parts_->evaluate(position, true);
}

}  // namespace patina
