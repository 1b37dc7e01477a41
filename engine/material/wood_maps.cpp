#include "engine/material/wood_maps.h"

#include <ATen/ops/empty.h>
#include <ATen/ops/tensor.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "engine/material/image_planes.h"
#include "engine/material/kept.h"
#include "engine/material/pixel_blocks.h"
#include "engine/material/wood_cut.h"

namespace patina::wood {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// Numbers that nobody has set.
using Buffer = std::unique_ptr<float[]>;

/// Rows of the grid that are worked on together, in buffers that a processor keeps near; one more lies behind
/// them but in the last block, for differences with it.
class Block {
 public:
  static std::int64_t count(std::int64_t rows) { return std::max<std::int64_t>(1, rows / height(rows)); }

  Block(const Cut& cut, std::int64_t index)
      : cut_(cut),
        columns_(cut.side() + 1),
        begin_(index * height(columns_)),
        rows_((index + 1 == count(columns_) ? columns_ : begin_ + height(columns_)) - begin_),
        seen_(std::min(rows_ + 1, columns_ - begin_)),
        first_(begin_ == 0 ? 1 : 0),
        x_(buffer(seen_)),
        y_(buffer(seen_)),
        rings_(buffer(seen_)),
        width_(buffer(rows_)) {
    noise::warp(cut.gnarl(begin_), seen_, {x_.get(), y_.get()});
    noise::rings(cut.growth(x_.get(), y_.get()), seen_ * columns_, rings_.get());
    ring_widths(field(), rows_, width_.get());
  }

  /// @param exponent  [n, n]: kept for the gradient
  void draw(const at::Tensor& grain, const at::Tensor& exponent, const at::Tensor& color,
            const at::Tensor& height, const at::Tensor& roughness) const {
    noise::streaks(streaks(), rows_ - first_, exponent.data_ptr<float>() + pixel());
    finish(cut_.ring(), cut_.contrast(), rows(exponent), {grain.data_ptr<float>() + place(), kGrainHeight},
           {from_pixel(patina::planes_of(color), pixel()), height.data_ptr<float>() + place(),
            roughness.data_ptr<float>() + pixel()});
  }

  /// @param by  gradients by color, height and roughness   @param sums  by the numbers; added to
  void differentiate(const at::Tensor& exponent, const at::Tensor& color, const variable_list& by,
                     double* sums) const {
    std::vector<float> by_rings(size(seen_)), by_x(size(seen_)), by_y(size(seen_));
    const Buffer by_width = buffer(rows_), by_exponent = buffer(rows_);
    finish_backward(cut_.ring(), cut_.contrast(), rows(exponent), from_pixel(const_planes_of(color), pixel()),
                    {from_pixel(const_planes_of(by[0]), pixel()), by[1].data_ptr<float>() + place(),
                     by[2].data_ptr<float>() + pixel()},
                    {by_rings.data(), by_width.get(), by_exponent.get(), sums + kRing, sums + kContrast});
    ring_widths_backward(field(), rows_, width_.get(), by_width.get(), by_rings.data());
    const std::int64_t of_pixels = first_ * columns_;
    noise::streaks_backward(streaks(), rows_ - first_, by_exponent.get(),
                            {by_x.data() + of_pixels, by_y.data() + of_pixels, sums + kStreaks,
                             sums + cut_.numbers().streak_weights()});
    noise::rings_backward(cut_.growth(x_.get(), y_.get()), seen_ * columns_, by_rings.data(),
                          {by_x.data(), by_y.data(), sums + kGrowth, sums + kRingPlanes});
    differentiate_cut(by_x, by_y, sums);
  }

 private:
  /// Rows of a block: as many as come near kBlock pixels, and at least two, which a difference needs.
  static std::int64_t height(std::int64_t rows) { return std::max<std::int64_t>(2, rows_of_a_block(rows)); }
  std::size_t size(std::int64_t rows) const { return static_cast<std::size_t>(rows * columns_); }
  Buffer buffer(std::int64_t rows) const { return std::make_unique_for_overwrite<float[]>(size(rows)); }

  void differentiate_cut(const std::vector<float>& by_x, const std::vector<float>& by_y, double* sums) const {
    std::vector<float> by_columns(size(1)), by_rows(size(1)), by_depths(size(1));
    noise::warp_backward(cut_.gnarl(begin_), seen_, {by_x.data(), by_y.data()},
                         {by_columns.data(), by_rows.data(), by_depths.data(), sums + kGnarl});
    for (const float by_column : by_columns) sums[kCut] += static_cast<double>(by_column);
    for (std::int64_t r = 0; r < seen_; ++r) {
      const auto row = static_cast<std::size_t>(r);
      const double by_row = static_cast<double>(by_rows[row]),
                   by_depth = static_cast<double>(by_depths[row]) * kAlongGrain,
                   place = cut_.row_place(begin_ + r);
      sums[kCut + 1] += by_row;
      sums[kCut + 2] += by_depth;
      sums[kCut + 3] += by_row * place;
      sums[kCut + 4] += by_depth * place;
    }
  }

  std::int64_t place() const { return begin_ * columns_; }
  std::int64_t pixel() const { return (begin_ - 1 + first_) * cut_.side(); }
  RingField field() const { return {rings_.get(), seen_, columns_}; }
  noise::Streaks streaks() const {
    return cut_.streaks(x_.get() + first_ * columns_, y_.get() + first_ * columns_);
  }
  Rows rows(const at::Tensor& exponent) const {
    return {rings_.get(), width_.get(), exponent.data_ptr<float>() + pixel(), rows_, first_, cut_.side()};
  }

  const Cut& cut_;
  std::int64_t columns_, begin_, rows_, seen_, first_;
  Buffer x_, y_, rings_, width_;
};

struct Maps : torch::autograd::Function<Maps> {
  /// @param parameters  [kParameters]
  static variable_list forward(AutogradContext* context, const at::Tensor& parameters, const WoodNoise& noise,
                               const at::Tensor& grain, double size_cm) {
    const std::int64_t n = grain.size(0) - 1;
    std::array<double, kParameters> values;
    std::copy_n(parameters.data_ptr<float>(), values.size(), values.begin());
    Cut cut(numbers_of(values, noise, size_cm / static_cast<double>(n)), noise, size_cm, n);
    const at::TensorOptions options = parameters.options();
    const at::Tensor exponent = at::empty({n, n}, options), color = at::empty({3, n, n}, options),
                     height = at::empty({n + 1, n + 1}, options), roughness = at::empty({n, n}, options);
    over_blocks(Block::count(n + 1), 1, [&](std::int64_t block, std::int64_t, std::int64_t) {
      Block(cut, block).draw(grain, exponent, color, height, roughness);
    });
    context->save_for_backward({exponent, color});
    context->saved_data["cut"] = keep(std::move(cut));
    return {color, height, roughness};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &exponent = saved[0], &color = saved[1];
    const Cut& cut = kept<Cut>(context->saved_data["cut"]);
    const variable_list by{outputs[0].contiguous(), outputs[1].contiguous(), outputs[2].contiguous()};
    const std::vector<double> sums =
        sums_over_blocks(Block::count(cut.side() + 1), 1, cut.numbers().values.size(),
                         [&](std::int64_t block, std::int64_t, double* of_block) {
                           Block(cut, block).differentiate(exponent, color, by, of_block);
                         });
    const std::array<double, kParameters> gradient = by_parameters(cut.numbers(), sums);
    return {
        at::tensor(at::ArrayRef<double>(gradient.data(), gradient.size()), exponent.options()), {}, {}, {}};
  }
};

}  // namespace
}  // namespace patina::wood

namespace patina {

WoodMaps wood_maps(const ParameterTensors& parameters, const WoodNoise& noise, const at::Tensor& grain,
                   double size_cm) {
  if (parameters.scalar_type() != at::kFloat) return wood_maps_by_tensors(parameters, noise, grain, size_cm);
  const auto maps =
      wood::Maps::apply(parameters.run(0, wood::kParameters), noise, grain.contiguous(), size_cm);
  return {maps[0], maps[1], maps[2]};
}

}  // namespace patina
