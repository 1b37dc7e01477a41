#include "engine/run/run_chains.h"

#include <deque>
#include <string>
#include <system_error>
#include <thread>

#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "engine/run/warmup_state.h"

namespace patina {
namespace {

void add_chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, std::deque<Chain>& chains) {
  const int k = static_cast<int>(chains.size());
  const auto add = [&] { chains.emplace_back(plan, meeting, shared, k); };
  std::error_code ignored;
  // A new file that does not fit on the disk can wait for room; a state that is damaged cannot be mended so.
  if (std::filesystem::exists(chain_state_file(plan.directory, k), ignored)) return add();
  if (std::filesystem::exists(chain_file(plan.directory, k), ignored))
    shared.edit_status([&](RunStatus& status) {
      status.message =
          "chain " + std::to_string(k + 1) + " has no saved state: it is drawn anew, to the same draws";
    });
  shared.write_or_pause(add);
}

/// Calls work(chain) for each, on a thread of its own.
template <class Work>
void for_all(std::deque<Chain>& chains, RunShared& shared, const Work& work) {
  std::vector<std::jthread> threads;
  try {
    for (Chain& chain : chains) threads.emplace_back([&] { work(chain); });
  } catch (const std::system_error&) {  // those that run wait for all: they are told to end
    shared.fail("The system has no threads left for the chains: ask for fewer, or close other programs.");
  }
}

/// The one of warm-up where the run is over already.
const Kernel& kernel_of_draws(const ChainPlan& plan, RunShared& shared) {
  if (!plan.kernel_of_draws || shared.control.token().stop_requested()) return plan.kernel;
  try {
    return plan.kernel_of_draws();
  } catch (const RunStopped&) {  // chains have files to close
  } catch (const std::exception& error) {
    shared.fail(error.what());
  }
  return plan.kernel;
}

}  // namespace

ChainsDone run_chains(const ChainPlan& plan, const WarmupRecord& record, RunShared& shared) {
  // Laplace's metric weighs as much as ten transitions a dimension, with which a covariance begins to be
  // known.
  const double laplace_worth = 10.0 * static_cast<double>(plan.target.dimension());
  WarmupMeeting meeting(
      plan.settings.chains, plan.metric, laplace_worth, plan.target.jagged(),
      [&](const WarmupRecord& held) {
        shared.write_or_pause([&] { write_warmup(plan.directory, plan.run_key, held); });
      },
      record);
  std::deque<Chain> chains;  // their addresses stay
  for (int k = 0; k < plan.settings.chains; ++k) add_chain(plan, meeting, shared, chains);
  for_all(chains, shared, [](Chain& chain) { chain.warm_up(); });
  const Kernel& kernel = kernel_of_draws(plan, shared);
  for_all(chains, shared, [&](Chain& chain) { chain.sample(kernel); });
  ChainsDone done;
  for (const Chain& chain : chains) {
    done.draws += chain.draws_after_warmup();
    done.warmup.push_back(chain.warmup_seconds());
    done.sampling.push_back(chain.sampling_seconds());
  }
  return done;
}

}  // namespace patina
