#include "resources/predictors/photo_examples.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/tensor.h>
#include <torch/serialize.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "engine/image.h"
#include "engine/material/capture_priors.h"
#include "engine/material/material.h"
#include "engine/material/photograph.h"
#include "engine/material/registry.h"
#include "engine/posterior/camera.h"
#include "engine/posterior/prior_transform.h"
#include "engine/prediction/photo_features.h"
#include "engine/prediction/predictor.h"
#include "engine/prediction/structure_features.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/rng.h"
#include "engine/summary/image_tensor.h"
#include "resources/networks/image_variants.h"

namespace patina {
namespace {

constexpr int kSurfaces = 16;  // irregularities: their maps take a while to make
// Far from the seeds of networks, of tests and of users.
constexpr std::uint64_t kFirstSurface = 0x7072'6564'0000;
constexpr double kMostNoise = 0.01;  // sd, in display units, of a chooser's photos

double log_uniform(double low, double high, Rng& rng) {
  return std::exp(std::log(low) + rng.uniform() * std::log(high / low));
}

/// Half of the photos are taken from where the usual field of view needs it.
Capture draw_capture(Rng& rng) {
  const Capture usual;
  const double size = log_uniform(4, 60, rng), other = log_uniform(0.7, 2.2, rng);
  return {size, size * (rng.below(2) == 0 ? usual.camera_cm / usual.size_cm : other)};
}

at::Tensor reduced(const at::Tensor& image, std::int64_t times) {
  return times == 1 ? image : at::avg_pool2d(image.unsqueeze(0), {times, times}, {times, times}).squeeze(0);
}

at::Tensor changed(at::Tensor render, Rng& rng) {
  for (int i = 0; i < 2; ++i) render = vary(render, render.flip({1, 2}), rng);
  if (rng.below(2) == 0) render = mottled(render, rng);
  return rng.below(2) == 0 ? sharpened(render, rng) : render;
}

/// With noise, and rounded to 8 bits.
Image recorded(Image image, Rng& rng) {
  const double noise = kMostNoise * rng.uniform();
  for (float& pixel : image.pixels)
    pixel = std::round(255 * std::clamp(pixel + static_cast<float>(noise * rng.normal()), 0.0f, 1.0f)) / 255;
  return image;
}

/// From phones at dusk to photos that were large and are reduced, of whose noise and JPEG little is left.
Camera draw_camera(Rng& rng) {
  Camera camera;
  camera.electrons = log_uniform(1000, 100'000, rng);
  camera.jpeg_quality = 75 + rng.below(26);
  return camera;
}

/// How renders become photos and are looked at, by those that tell parameters and those that tell materials.
struct View {
  int side;
  int one_in;  ///< so many is rendered at twice the pixels
  Eigen::Index features;
  std::function<Image(const at::Tensor& render, Rng&)> take;
  std::function<Eigen::VectorXf(const Image&, const Capture&)> look;
};

/// A photo's pixels are means over their area: all are rendered at twice the pixels.
View view_of_parameters() {
  const PhotoFeatures features(Predictor::kSide);
  const auto take = [](const at::Tensor& render, Rng& rng) {
    const Camera camera = draw_camera(rng);
    return photographed(to_image(render), camera, rng);
  };
  return {Predictor::kSide, 1, features.size(), take, features};
}

View view_of_structure() {
  constexpr int kSide = StructureFeatures::kSide;
  const StructureFeatures features;
  const auto take = [](const at::Tensor& render, Rng& rng) {
    return recorded(to_image(changed(reduced(render, render.size(2) / kSide), rng)), rng);
  };
  return {kSide, 2, features.size(), take,
          [features](const Image& photo, const Capture&) { return features(photo); }};
}

}  // namespace

PhotoExamples simulate_photos(const std::string& material, int count, std::uint64_t seed, int threads,
                              bool varied) {
  const auto model = make_material(material);
  const View view = varied ? view_of_structure() : view_of_parameters();
  std::vector<std::unique_ptr<Irregularities>> pool;
  for (std::uint64_t i = 0; i < kSurfaces; ++i)
    pool.push_back(std::make_unique<Irregularities>(kFirstSurface + kSurfaces * seed + i));
  const auto p = std::ssize(model->table().continuous), choices = std::ssize(model->table().discrete);
  PhotoExamples photos{at::empty({count, view.features}, at::kFloat), at::empty({count, p}, at::kFloat),
                       at::empty({count, choices}, at::kLong)};
  const auto simulate = [&](std::size_t i) {
    const at::NoGradGuard no_grad;
    Rng rng(kFirstSurface + seed, i);
    const Capture capture = draw_capture(rng);
    const ParameterTable table = table_under(model->table(), capture);
    const Eigen::VectorXf coordinates = rng.normals(p).cast<float>();
    std::vector<int> levels;
    for (const DiscreteParameter& choice : table.discrete)
      levels.push_back(rng.below(static_cast<int>(choice.levels.size())));
    const std::vector<double> values = values_at(table, coordinates.cast<double>());
    const int side = view.side * (rng.below(view.one_in) == 0 ? 2 : 1);
    const Surface surface =
        model->surface(at::tensor(values, at::kFloat), levels, *pool[i % kSurfaces], capture, side);
    const at::Tensor render = photograph(surface, capture, side, DisplayCurve::srgb);
    const Image photo = view.take(render, rng);
    const Eigen::VectorXf seen = view.look(photo, capture);
    std::ranges::copy(seen, photos.features.data_ptr<float>() + static_cast<std::ptrdiff_t>(i) * seen.size());
    std::ranges::copy(coordinates, photos.coordinates.data_ptr<float>() + static_cast<std::ptrdiff_t>(i) * p);
    std::ranges::copy(levels,
                      photos.levels.data_ptr<std::int64_t>() + static_cast<std::ptrdiff_t>(i) * choices);
  };
  parallel_for(static_cast<std::size_t>(count), threads, simulate, [] { at::set_num_threads(1); });
  return photos;
}

void save(const PhotoExamples& photos, const std::filesystem::path& file) {
  torch::save(std::vector<at::Tensor>{photos.features, photos.coordinates, photos.levels}, file.string());
}

PhotoExamples load_photo_examples(const std::filesystem::path& file) {
  std::vector<at::Tensor> tensors;
  torch::load(tensors, file.string());
  return {tensors.at(0), tensors.at(1), tensors.at(2)};
}

}  // namespace patina
