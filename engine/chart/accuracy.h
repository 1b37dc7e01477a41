#pragma once

#include <cstdint>
#include <string>

#include "engine/chart/gold_standard.h"

namespace patina {

/// The largest of the errors of several quantities.
struct WorstError {
  double value = 0;         ///< NaN: there is none
  double bar = 0;           ///< Monte Carlo standard error of `value`, both samples'
  std::string of;           ///< whose it is
  double largest_bars = 0;  ///< the largest, over all quantities, of an error over its own bar
};

/// How far draws are from the gold standard, and how many they are worth.
struct Accuracy {
  WorstError mean;         ///< |difference of means| / gold sd
  WorstError sd;           ///< |log of the ratio of sds|
  WorstError wasserstein;  ///< Wasserstein-1 distance / gold sd; bar: see below
  WorstError levels;       ///< total variation distance of a discrete quantity's levels
  double least_ess = 0;    ///< bulk ESS of the worst quantity; NaN for fewer than four draws a chain
  std::string least_ess_of;
  double largest_rhat = 0;
};

/// Compares quantity by quantity. Being a metric, the distance of two samples is off by no more than how far
/// each is from its own law; the bars of Wasserstein-1 and of total variation are that, so that samples of
/// one law are about a bar apart, not zero.
/// @param seed  of the bootstrap
Accuracy compare(const QuantityDraws& draws, const GoldStandard& gold, std::uint64_t seed);

}  // namespace patina
