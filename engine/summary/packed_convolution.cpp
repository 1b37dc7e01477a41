#include "engine/summary/packed_convolution.h"

#include <ATen/Context.h>
#include <ATen/core/dispatch/Dispatcher.h>
#include <ATen/core/ivalue.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina {
namespace {

// For maps of about this size the library chooses how weights lie; others are convolved as well.
constexpr std::int64_t kUsualSide = 64;

std::optional<c10::OperatorHandle> operator_named(const char* name) {
  const auto found = c10::Dispatcher::singleton().findSchema({name, ""});
  return found ? std::optional(*found) : std::nullopt;
}

c10::IValue call(const c10::OperatorHandle& op, std::vector<c10::IValue> arguments) {
  op.callBoxed(&arguments);
  return std::move(arguments.front());
}

class Packed final : public PackedConvolution {
 public:
  Packed(const c10::OperatorHandle& run, c10::IValue weights) : run_(run), weights_(std::move(weights)) {}

  at::Tensor of(const at::Tensor& x) const override { return call(run_, {x, weights_}).toTensor(); }

 private:
  c10::OperatorHandle run_;
  c10::IValue weights_;
};

}  // namespace

std::shared_ptr<const PackedConvolution> PackedConvolution::make(const at::Tensor& weight,
                                                                 const at::Tensor& bias, bool relu,
                                                                 std::int64_t padding) {
  using Numbers = std::vector<std::int64_t>;
  const at::Context& library = at::globalContext();
  const auto prepack = operator_named("mkldnn_prepacked::conv2d_prepack");
  const auto run = operator_named("mkldnn_prepacked::conv2d_run");
  if (!prepack || !run || !weight.is_cpu() || weight.scalar_type() != at::kFloat || !library.hasMKLDNN() ||
      !library.userEnabledMkldnn())
    return nullptr;
  const Numbers usual{1, weight.size(1), kUsualSide, kUsualSide}, one{1, 1};
  return std::make_shared<const Packed>(
      *run, call(*prepack, {weight, bias, one, Numbers{padding, padding}, one, std::int64_t{1}, usual,
                            std::string(relu ? "relu" : "none")}));
}

}  // namespace patina
