#pragma once

#include <functional>

#include "engine/sampling/log_density.h"

namespace patina {

/// Above so many nats of noise in the log density draws are wrong, and nothing in them shows it: at 0.3 the
/// variance is 2 % too large, at 1 14 %, with acceptance as before (MALA on N(0, I) in 8 dimensions).
constexpr double kMostNoise = 0.1;

/// The sd of the log density of one place over repeated evaluations of its value; 0 for a function. No kernel
/// leaves a target invariant that is drawn anew in each evaluation (fresh irregularities, sums in an order
/// that changes), and no diagnostic of draws shows it. 0 for fewer than two repeats, infinite where values
/// are finite only now and then.
/// @param threads  evaluations at a time: also shows threads that get in each other's way
double value_noise(const LogDensity& target, const Position& place, int repeats, int threads = 1,
                   const std::function<void()>& enter_thread = {});

}  // namespace patina
