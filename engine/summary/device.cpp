#include "engine/summary/device.h"

#include <ATen/Context.h>

#include "engine/error.h"

namespace patina {

std::vector<std::string> device_names() { return {"cpu", "cuda"}; }

Device device_named(const std::string& name) {
  if (name == "cpu") return Device::cpu;
  if (name == "cuda") return Device::cuda;
  throw UserError("There is no device '" + name + "': use cpu or cuda.");
}

bool is_at_hand(Device device) { return device == Device::cpu || at::globalContext().hasCUDA(); }

void check_at_hand(Device device) {
  if (!is_at_hand(device))
    throw UserError(
        "CUDA finds no graphics card, or Patina was built with a libtorch that has no CUDA: leave the device "
        "at cpu.");
}

}  // namespace patina
