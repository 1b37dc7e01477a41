#include "engine/run/emulated_proposals.h"

#include <atomic>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"

namespace patina {

std::vector<std::string> run_kernel_names() {
  std::vector<std::string> names = kernel_names();
  names.push_back(kEmulated);
  return names;
}

void check_can_emulate(const RunSettings& settings, const Posterior& posterior) {
  const auto refuse = [](const std::string& why) {
    throw UserError("The kernel emulated " + why + ": use --kernel hmc.");
  };
  if (!can_emulate(posterior))
    refuse("follows no choices and no places of a texture, which " + settings.material + " has");
  if (settings.errors != "paper") refuse("is of no use with calibrated errors, which need no renders");
  if (settings.temper != 0) refuse("has no ladder");
  if (settings.start != "map") refuse("begins at the best match alone");
}

Emulator learn_emulator(const Posterior& posterior, const Position& mode, const Metric& laplace,
                        std::uint64_t seed, RunShared& shared) {
  constexpr int kEvaluationsAMessage = 20;
  std::atomic<int> made{0};
  const EmulateSettings settings{
      .threads = hardware_threads(),
      .seed = seed,
      .enter_thread = [] { use_tensor_threads(1); },
      .evaluated =
          [&] {
            shared.control.checkpoint();
            const int now = ++made;
            if (now % kEvaluationsAMessage != 0) return;
            shared.edit_status([&](RunStatus& status) {
              status.message = format("learning what renders look like about the match: %d so far", now);
            });
          }};
  Emulation made_of = emulate(posterior, mode, laplace, settings);
  if (!made_of.emulator)
    throw UserError(
        format("Polynomials do not follow the renders about this match (log densities are off by "
               "%.1f nats): use --kernel hmc.",
               made_of.error));
  return std::move(*made_of.emulator);
}

}  // namespace patina
