#include "engine/posterior/simulate.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>

#include <Eigen/Cholesky>

namespace patina {

SimulatedPhotos simulate(const ForwardModel& model, const ParameterSpace& space,
                         const at::Tensor& inverse_sigma, const Position& centre,
                         const Eigen::MatrixXd& covariance, const SimulationSettings& settings,
                         IrregularityPool& pool) {
  const at::NoGradGuard no_grad;
  SimulatedPhotos simulated{centre.continuous, {}, {}, {}, {}};
  for (Eigen::Index i = 0; i < space.dimension(); ++i)
    if (!space.table().continuous[space.free()[static_cast<std::size_t>(i)]].place)
      simulated.informed.push_back(i);
  const Eigen::MatrixXd block = covariance(simulated.informed, simulated.informed);
  simulated.factor = block.llt().matrixL();
  simulated.offsets.resize(std::ssize(simulated.informed), settings.photos);
  simulated.summaries.resize(inverse_sigma.numel(), settings.photos);
  Rng rng(settings.seed);
  for (Eigen::Index i = 0; i < settings.photos; ++i) {
    simulated.offsets.col(i) = rng.normals(simulated.offsets.rows());
    Position position{rng.normals(space.dimension()), centre.discrete};
    position.continuous(simulated.informed) =
        centre.continuous(simulated.informed) + simulated.factor * simulated.offsets.col(i);
    const auto z = pool[static_cast<std::size_t>(i)];
    const at::Tensor summary =
        (model.summary_of_photo(space.values(position), *z, settings.camera, rng) * inverse_sigma)
            .to(at::kDouble)
            .contiguous();
    simulated.summaries.col(i) =
        Eigen::Map<const Eigen::VectorXd>(summary.data_ptr<double>(), summary.numel());
  }
  return simulated;
}

}  // namespace patina
