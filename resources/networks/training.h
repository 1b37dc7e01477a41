#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "resources/networks/student.h"
#include "resources/networks/training_set.h"

namespace patina {

struct TrainingSettings {
  int steps = 900;
  int family = 1;               ///< images of a family, one after the other in a set
  int batch = 24;               ///< images a step of the first set; of sets of larger ones as many pixels
  double learning_rate = 2e-3;  ///< at its highest
  double held_back = 0.125;     ///< share of each set's families that validate and do not train
  int report_every = 100;       ///< steps
  std::uint64_t seed = 1;
};

struct TrainingReport {
  int step = 0;
  double loss = 0;                       ///< mean since the last report
  std::vector<double> rank_correlation;  ///< Spearman's, of all held-back pairs of each set
  bool best = false;                     ///< no earlier step had as high a mean of those
};

/// Teaches a network the teacher's distances: Adam on the mean squared difference of the logarithms of both
/// networks' distances, of the mean over taps and of each tap, over all pairs of a batch. Half of the batches
/// come from a part of a set only, one material's as sets are ordered; every batch comes from one set. The
/// learning rate rises for the first twentieth and falls as a cosine.
/// @param report  called every report_every steps and at the end
void train(Student& student, const std::vector<TrainingSet>& sets, const TrainingSettings& settings,
           const std::function<void(const TrainingReport&)>& report);

/// Spearman's correlation of student's and teacher's distances over all pairs of some images of a set.
double rank_correlation(const Student& student, const TrainingSet& set,
                        const std::vector<std::int64_t>& images);

}  // namespace patina
