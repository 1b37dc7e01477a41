#include "engine/posterior/forward_model.h"

#include <ATen/core/grad_mode.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/io/photo.h"
#include "engine/material/photograph.h"
#include "engine/summary/feature_steps.h"
#include "engine/summary/image_tensor.h"

namespace patina {
ForwardModel::ForwardModel(std::shared_ptr<const Material> material, std::shared_ptr<const Summary> summary,
                           const Capture& capture, int resolution)
    : material(std::move(material)),
      summary(std::move(summary)),
      capture(capture),
      resolution(resolution),
      resampling(std::make_shared<const Resampling>(resolution)) {}

at::Tensor ForwardModel::summary_of_render(const ParameterTensors& parameters,
                                           const std::vector<int>& discrete, const Irregularities& z) const {
  const int times = material->oversampling(), side = times * resolution;
  assert(times == 1 || times == 2);
  const at::Tensor image = photograph(material->surface(parameters, discrete, z, capture, side), capture,
                                      side, DisplayCurve::srgb);
  const at::Tensor images = image.unsqueeze(0);
  return summary->of(times == 1 ? images : average_pool(images)).squeeze(0);
}

Image ForwardModel::photo(const ParameterValues& values, const Irregularities& z, const Camera& camera,
                          Rng& rng) const {
  const at::NoGradGuard no_grad;
  const int asked = resolution * camera.oversampling;
  const int side = material->oversampling() > 1 ? std::max(asked, camera.least_side) : asked;
  const Surface surface =
      material->surface(at::tensor(values.continuous, at::kFloat), values.discrete, z, capture, side);
  return photographed(to_image(photograph(surface, capture, side, DisplayCurve::srgb)), camera, rng);
}

at::Tensor ForwardModel::summaries_of_photos(std::span<const Image> photos) const {
  const at::NoGradGuard no_grad;
  std::vector<at::Tensor> images;
  for (const Image& photo : photos) images.push_back((*resampling)(to_tensor(photo)));
  return summary->of(at::stack(images));
}

at::Tensor ForwardModel::summary_of(const Image& photo) const {
  const at::NoGradGuard no_grad;
  return (*summary)(to_tensor(resized(photo, resolution)));
}

}  // namespace patina
