#include "engine/run/run_target.h"

#include "engine/posterior/emulated_moves.h"
#include "engine/run/emulated_proposals.h"
#include "engine/sampling/kernels.h"

namespace patina {
namespace {

std::unique_ptr<const VettedDensity> average_of(const Posterior& posterior, const ModeFound& found) {
  if (!found.average) return nullptr;
  return averaged(posterior, *found.wider, *found.average);
}

}  // namespace

RunTarget::RunTarget(const Posterior& posterior, const ModeFound& found, const RunSettings& settings,
                     RunControl& control)
    : posterior_(posterior),
      found_(found),
      settings_(settings),
      average_(average_of(posterior, found)),
      density_(average_ ? static_cast<const LogDensity&>(*average_) : posterior, control) {}

std::unique_ptr<Kernel> RunTarget::kernel() const {
  if (average_) return make_emulated_kernel(*average_, settings_.path_length);
  if (found_.emulator)
    return make_emulated_kernel(*found_.emulator, posterior_.informed(), density_, settings_.path_length);
  return make_kernel(kernel_in_use(settings_, /*emulated=*/false), density_, settings_.alpha,
                     settings_.refresh.value(), settings_.discrete, settings_.path_length);
}

ChainState RunTarget::mode() const {
  if (!average_) return found_.mode;
  const Position& position = found_.mode.position;
  return {position, density_.evaluate(position)};
}

std::shared_ptr<const Metric> RunTarget::spread() const {
  return average_ ? std::make_shared<const Metric>(found_.average->covariance) : found_.laplace;
}

}  // namespace patina
