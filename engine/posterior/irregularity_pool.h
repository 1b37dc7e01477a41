#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/material/irregularities.h"
#include "engine/material/parameter.h"

namespace patina {

/// Irregularities to simulate with, made once each where they are dear. For several threads.
class IrregularityPool {
 public:
  /// @param size  how many are kept and dealt in turn; 0: each is new
  IrregularityPool(std::uint64_t first_seed, std::size_t size) : first_seed_(first_seed), kept_(size) {}

  std::shared_ptr<const Irregularities> operator[](std::size_t i) {
    if (kept_.empty()) return std::make_shared<const Irregularities>(first_seed_ + i);
    const std::size_t slot = i % kept_.size();
    const std::lock_guard lock(mutex_);
    if (!kept_[slot]) kept_[slot] = std::make_shared<const Irregularities>(first_seed_ + slot);
    return kept_[slot];
  }

 private:
  std::uint64_t first_seed_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Irregularities>> kept_;
};

/// The first seed of irregularities to simulate with: none is one that a user would choose for a run's own.
constexpr std::uint64_t kSimulatedSeeds = 1'000'000'000;

/// For a material that has places few, dealt anew by where their maps are looked at; else as many as are
/// asked for.
/// @param most  that are kept where they are dear
std::shared_ptr<IrregularityPool> make_pool(const ParameterTable& table, std::uint64_t first_seed,
                                            std::size_t most = 128);

}  // namespace patina
