#pragma once

#include <ATen/core/ivalue.h>
#include <torch/custom_class.h>

#include <utility>

namespace patina {

/// What a gradient needs beside tensors, as AutogradContext::saved_data takes it.
template <class Value>
struct Kept : torch::CustomClassHolder {
  const Value value;
  explicit Kept(Value kept) : value(std::move(kept)) {}
};

template <class Value>
at::IValue keep(Value value) {
  return at::IValue::make_capsule(c10::make_intrusive<Kept<Value>>(std::move(value)));
}

/// @param capsule  what keep<Value>() made; outlives the result
template <class Value>
const Value& kept(const at::IValue& capsule) {
  return static_cast<const Kept<Value>*>(capsule.toCapsule().get())->value;
}

}  // namespace patina
