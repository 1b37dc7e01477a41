#include "engine/run/emulated_proposals.h"

#include <atomic>
#include <utility>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"

namespace patina {

namespace {

/// Why a run's proposals cannot be emulated; empty if they may be.
std::string hindrance(const RunSettings& settings, const Posterior& posterior) {
  if (!can_emulate(posterior))
    return "follows no choices and no places of a texture, which " + settings.material + " has";
  if (settings.errors != "paper") return "is of no use with calibrated errors, which need no renders";
  if (settings.temper != 0) return "has no ladder";
  if (settings.start != "map") return "begins at the best match alone";
  return "";
}

}  // namespace

std::vector<std::string> run_kernel_names() {
  std::vector<std::string> names = kernel_names();
  names.insert(names.end(), {kEmulated, kAuto});
  return names;
}

bool emulates(const RunSettings& settings, const Posterior& posterior) {
  if (settings.kernel != kEmulated && settings.kernel != kAuto) return false;
  const std::string why_not = hindrance(settings, posterior);
  if (!why_not.empty() && settings.kernel == kEmulated)
    throw UserError("The kernel emulated " + why_not + ": use --kernel hmc.");
  return why_not.empty();
}

std::string kernel_in_use(const RunSettings& settings, bool emulated) {
  if (settings.kernel != kAuto) return settings.kernel;
  return emulated ? kEmulated : "hmc";
}

std::optional<Emulator> learn_emulator(const Posterior& posterior, const ChainState& mode,
                                       const Metric& laplace, const std::vector<MapPoint>& basins,
                                       const RunSettings& run, RunShared& shared) {
  constexpr int kEvaluationsAMessage = 20;
  std::atomic<int> evaluated{0};
  const EmulateSettings settings{
      .threads = hardware_threads(),
      .seed = run.seed,
      .enter_thread = [] { use_tensor_threads(1); },
      .evaluated =
          [&] {
            shared.control.checkpoint();
            const int now = ++evaluated;
            if (now % kEvaluationsAMessage != 0) return;
            shared.edit_status([&](RunStatus& status) {
              status.message = format("learning what renders look like about the match: %d so far", now);
            });
          }};
  std::vector<ChainState> ends;
  for (const MapPoint& basin : basins) ends.push_back({posterior.position(basin.values), {basin.lp, {}}});
  Emulation made = emulate(posterior, mode.position, laplace, settings);
  std::string why_not;
  if (!made.emulator)
    why_not =
        format("Polynomials do not follow the renders about this match (log densities are off by %.1f nats)",
               made.error);
  else if (misses_one(*made.emulator, mode, ends))
    why_not = "There are other matches about as good, which polynomials about this one do not follow";
  if (why_not.empty()) return std::move(made.emulator);
  if (run.kernel == kEmulated) throw UserError(why_not + ": use --kernel hmc.");
  return std::nullopt;
}

}  // namespace patina
