#include "engine/material/photograph.h"

#include <ATen/ops/empty.h>
#include <torch/csrc/autograd/custom_function.h>

#include <utility>

#include "engine/material/capture_view.h"
#include "engine/material/image_planes.h"
#include "engine/material/pixel_blocks.h"
#include "engine/material/shading.h"
#include "engine/material/shading_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// Where the tensors of a lobe lie among the inputs.
struct LobeInputs {
  std::int64_t normal, f0, roughness_x, roughness_y;
};

/// The tensors that a photograph depends on, each once.
struct Inputs {
  static constexpr std::int64_t kLight = 0, kVignetteSigma = 1, kBaseColor = 2, kNormal = 3;
  variable_list tensors;
  std::vector<LobeInputs> lobes;
};

at::Tensor as_colour(const at::Tensor& colour) {
  const at::Tensor planes = colour.dim() == 1 ? colour.view({-1, 1, 1}) : colour;
  return planes.expand({3, planes.size(1), planes.size(2)});
}

/// As the kernel reads it: planes without gaps, however far apart, or one number for all of one's pixels.
/// Copies only where neither is so.
at::Tensor as_planes(const at::Tensor& tensor) {
  if (tensor.dim() < 3) return tensor.contiguous();
  if (tensor.stride(1) == 0 && tensor.stride(2) == 0) return tensor.narrow(1, 0, 1).narrow(2, 0, 1);
  return tensor[0].is_contiguous() ? tensor : tensor.contiguous();
}

Inputs collect(const Surface& surface) {
  Inputs inputs{{surface.light, surface.vignette_sigma, as_colour(surface.base_color), surface.normal}, {}};
  const auto add = [&](const at::Tensor& tensor) {
    inputs.tensors.push_back(tensor);
    return static_cast<std::int64_t>(inputs.tensors.size()) - 1;
  };
  for (const Lobe& lobe : surface.lobes) {
    LobeInputs at{};
    at.normal = lobe.normal.is_same(surface.normal) ? Inputs::kNormal : add(lobe.normal);
    at.f0 = add(as_colour(lobe.f0));
    at.roughness_x = add(lobe.roughness_x);
    at.roughness_y = lobe.roughness_y.is_same(lobe.roughness_x) ? at.roughness_x : add(lobe.roughness_y);
    inputs.lobes.push_back(at);
  }
  for (at::Tensor& tensor : inputs.tensors) tensor = as_planes(tensor);
  return inputs;
}

std::vector<std::int64_t> flat(const std::vector<LobeInputs>& lobes) {
  std::vector<std::int64_t> numbers;
  for (const LobeInputs& lobe : lobes)
    numbers.insert(numbers.end(), {lobe.normal, lobe.f0, lobe.roughness_x, lobe.roughness_y});
  return numbers;
}

std::vector<LobeInputs> lobes_of(const std::vector<std::int64_t>& numbers) {
  std::vector<LobeInputs> lobes;
  for (std::size_t i = 0; i < numbers.size(); i += 4)
    lobes.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  return lobes;
}

std::int64_t plane_count(const at::Tensor& tensor) { return tensor.dim() == 3 ? tensor.size(0) : 1; }

/// A problem of fields whose first planes lie in the same order as its tensors.
struct Laid {
  ShadingProblem problem;
  std::vector<std::size_t> first;  ///< of each tensor, its first field
};

/// @param view  outlives the result, as the tensors do
Laid lay_out(const variable_list& tensors, const std::vector<LobeInputs>& lobes, const CaptureView& view,
             DisplayCurve curve) {
  Laid laid;
  laid.problem.side = view.offset.numel();
  laid.problem.offset = view.offset.data_ptr<float>();
  laid.problem.inverse_distance = view.inverse_distance.data_ptr<float>();
  laid.problem.camera_cm = static_cast<float>(view.camera_cm);
  laid.problem.light = *tensors[Inputs::kLight].data_ptr<float>();
  laid.problem.vignette_sigma = *tensors[Inputs::kVignetteSigma].data_ptr<float>();
  laid.problem.curve = curve;
  laid.first.resize(tensors.size());
  for (std::size_t t = Inputs::kBaseColor; t < tensors.size(); ++t) {
    laid.first[t] = laid.problem.fields.size();
    const at::Tensor& tensor = tensors[t];
    const std::int64_t planes = plane_count(tensor), step = planes == 1 ? 0 : tensor.stride(0);
    for (std::int64_t k = 0; k < planes; ++k)
      laid.problem.fields.push_back({tensor.data_ptr<float>() + k * step, tensor.numel() == planes});
  }
  const auto field = [&](std::int64_t tensor) { return laid.first[static_cast<std::size_t>(tensor)]; };
  for (const LobeInputs& lobe : lobes)
    laid.problem.lobes.push_back(
        {field(lobe.normal), field(lobe.f0), field(lobe.roughness_x), field(lobe.roughness_y)});
  return laid;
}

CaptureView view_of(double size_cm, double camera_cm, std::int64_t resolution) {
  return capture_view({size_cm, camera_cm}, static_cast<int>(resolution), at::kFloat);
}

/// Gradient tensors of the inputs that want one, and the kernel's view of a block of them.
class InputGradients {
 public:
  InputGradients(AutogradContext& context, const variable_list& tensors, const Laid& laid)
      : laid_(laid), gradients_(tensors.size()) {
    for (std::size_t t = 0; t < tensors.size(); ++t)
      if (context.needs_input_grad(t)) gradients_[t] = at::empty(tensors[t].sizes(), tensors[t].options());
  }

  /// @param sums  one for each field
  ShadingGradient block(double* sums) const {
    ShadingGradient gradient;
    gradient.fields.resize(laid_.problem.fields.size());
    for_each_field([&](std::size_t field, float* data, bool uniform) {
      (uniform ? void(gradient.fields[field].sum = &sums[field]) : void(gradient.fields[field].plane = data));
    });
    return gradient;
  }

  void set_uniform(const std::vector<double>& sums, double light, double vignette_sigma) {
    for_each_field([&](std::size_t field, float* data, bool uniform) {
      if (uniform) *data = static_cast<float>(sums[field]);
    });
    set(Inputs::kLight, light);
    set(Inputs::kVignetteSigma, vignette_sigma);
  }

  variable_list take() { return std::move(gradients_); }

 private:
  template <class F>
  void for_each_field(const F& f) const {
    for (std::size_t t = Inputs::kBaseColor; t < gradients_.size(); ++t) {
      if (!gradients_[t].defined()) continue;
      const std::int64_t planes = plane_count(gradients_[t]), step = gradients_[t].numel() / planes;
      for (std::int64_t k = 0; k < planes; ++k)
        f(laid_.first[t] + static_cast<std::size_t>(k), gradients_[t].data_ptr<float>() + k * step,
          step == 1);
    }
  }

  void set(std::int64_t t, double value) {
    if (const at::Tensor& gradient = gradients_[static_cast<std::size_t>(t)]; gradient.defined())
      *gradient.data_ptr<float>() = static_cast<float>(value);
  }

  const Laid& laid_;
  variable_list gradients_;
};

struct Photograph : torch::autograd::Function<Photograph> {
  static at::Tensor forward(AutogradContext* context, at::TensorList inputs,
                            const std::vector<std::int64_t>& lobes, double size_cm, double camera_cm,
                            std::int64_t resolution, std::int64_t curve) {
    const variable_list tensors = inputs.vec();
    const CaptureView view = view_of(size_cm, camera_cm, resolution);
    const Laid laid = lay_out(tensors, lobes_of(lobes), view, static_cast<DisplayCurve>(curve));
    const at::Tensor image = at::empty({3, resolution, resolution}, tensors.front().options());
    const Planes planes = planes_of(image);
    over_blocks(resolution, rows_of_a_block(resolution),
                [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                  shade_pixels(laid.problem, begin, end, planes);
                });
    variable_list kept = tensors;
    kept.push_back(image);
    context->save_for_backward(kept);
    context->saved_data["lobes"] = lobes;
    context->saved_data["size_cm"] = size_cm;
    context->saved_data["camera_cm"] = camera_cm;
    context->saved_data["resolution"] = resolution;
    context->saved_data["curve"] = curve;
    return image;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    auto& saved = context->saved_data;
    variable_list tensors = context->get_saved_variables();
    const at::Tensor image = tensors.back();
    tensors.pop_back();
    const CaptureView view =
        view_of(saved["size_cm"].toDouble(), saved["camera_cm"].toDouble(), saved["resolution"].toInt());
    const Laid laid = lay_out(tensors, lobes_of(saved["lobes"].toIntVector()), view,
                              static_cast<DisplayCurve>(saved["curve"].toInt()));
    const at::Tensor image_gradient = outputs.front().contiguous();
    const ConstPlanes values = const_planes_of(image), by_values = const_planes_of(image_gradient);

    InputGradients gradients(*context, tensors, laid);
    const std::size_t fields = laid.problem.fields.size();
    const std::int64_t side = image.size(1);
    const std::vector<double> total = sums_over_blocks(
        side, rows_of_a_block(side), fields + 2, [&](std::int64_t begin, std::int64_t end, double* sums) {
          ShadingGradient gradient = gradients.block(sums);
          shade_pixels_backward(laid.problem, begin, end, values, by_values, gradient);
          sums[fields] = gradient.light;
          sums[fields + 1] = gradient.vignette_sigma;
        });
    gradients.set_uniform(total, total[fields], total[fields + 1]);

    variable_list result = gradients.take();
    result.resize(result.size() + 5);  // nothing for the arguments that are no tensors
    return result;
  }
};

}  // namespace

at::Tensor photograph(const Surface& surface, const Capture& capture, int resolution, DisplayCurve curve) {
  if (surface.light.scalar_type() != at::kFloat) return display(shade(surface, capture, resolution), curve);
  const Inputs inputs = collect(surface);
  return Photograph::apply(at::TensorList(inputs.tensors), flat(inputs.lobes), capture.size_cm,
                           capture.camera_cm, static_cast<std::int64_t>(resolution),
                           static_cast<std::int64_t>(curve));
}

}  // namespace patina
