#include "resources/networks/training.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/triu_indices.h>
#include <torch/optim/adam.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/sampling/rng.h"
#include "resources/networks/gram_distance.h"

namespace patina {
namespace {

constexpr double kFloor = 0.02;     // added to distances: below it they are one
constexpr double kTapWeight = 0.5;  // of the single taps in the loss
constexpr int kSmallestBatch = 12;
constexpr double kGradientLimit = 1;
constexpr std::int64_t kPart = 7;  // families of a set lie ordered by material, of which there are seven

using Indices = std::vector<std::int64_t>;

/// Entries above the diagonal of square matrices [..., n, n]: [..., n (n - 1) / 2].
at::Tensor pairs_of(const at::Tensor& square) {
  const std::int64_t n = square.size(-1);
  const at::Tensor upper = at::triu_indices(n, n, 1);
  return square.flatten(-2).index_select(-1, upper[0] * n + upper[1]);
}

/// Of all pairs of images. @return [taps, pairs]
at::Tensor student_distances(const Student& student, const at::Tensor& images) {
  std::vector<at::Tensor> taps;
  for (const at::Tensor& gram : student.grams(images)) {
    // In double precision, so that the difference of close squares keeps its digits.
    const at::Tensor rows = gram.to(at::kDouble), products = rows.mm(rows.t()), squares = products.diagonal();
    const at::Tensor apart = pairs_of(squares.unsqueeze(0) + squares.unsqueeze(1) - 2 * products);
    const at::Tensor norms = squares.clamp_min(1e-30).sqrt();
    taps.push_back(2 * apart.clamp_min(1e-20).sqrt() / pairs_of(norms.unsqueeze(0) + norms.unsqueeze(1)));
  }
  return at::stack(taps);
}

at::Tensor teacher_distances(const TrainingSet& set, const at::Tensor& images) {
  return pairs_of(set.distances.index_select(1, images).index_select(2, images)).to(at::kDouble);
}

at::Tensor squared_log_ratio(const at::Tensor& a, const at::Tensor& b) {
  return ((a + kFloor).log() - (b + kFloor).log()).square().mean();
}

at::Tensor loss(const at::Tensor& student, const at::Tensor& teacher) {
  return squared_log_ratio(student.mean(0), teacher.mean(0)) +
         kTapWeight * squared_log_ratio(student, teacher);
}

/// Which families of a set train and which validate: every k-th is held back.
struct Split {
  Indices training, held_back;
};

Split split(std::int64_t families, double share) {
  const auto stride = static_cast<std::int64_t>(std::lround(1 / share));
  Split split;
  for (std::int64_t i = 0; i < families; ++i)
    (i % stride == stride / 2 ? split.held_back : split.training).push_back(i);
  return split;
}

/// At most `limit` images: three at random (or all) of each of as many families as it takes.
Indices draw_batch(const Indices& families, const TrainingSettings& settings, int limit, Rng& rng) {
  const int of_each = std::min(3, settings.family);
  const auto size = static_cast<std::int64_t>(families.size());
  std::int64_t first = 0, count = size;
  if (rng.below(2) == 0) {
    count = std::max<std::int64_t>(1, size / kPart);
    first = rng.below(static_cast<int>(size - count + 1));
  }
  Indices chosen(static_cast<std::size_t>(count)), images;
  std::iota(chosen.begin(), chosen.end(), first);
  std::shuffle(chosen.begin(), chosen.end(), rng);
  for (const std::int64_t i : chosen) {
    if (static_cast<int>(images.size()) + of_each > limit) break;
    Indices members(static_cast<std::size_t>(settings.family));
    std::iota(members.begin(), members.end(), families[static_cast<std::size_t>(i)] * settings.family);
    std::shuffle(members.begin(), members.end(), rng);
    images.insert(images.end(), members.begin(), members.begin() + of_each);
  }
  return images;
}

double learning_rate(const TrainingSettings& settings, int step) {
  const double done = static_cast<double>(step) / settings.steps, rise = 0.05;
  const double shape = done < rise ? (done + 1.0 / settings.steps) / rise
                                   : 0.5 + 0.5 * std::cos(std::numbers::pi * (done - rise) / (1 - rise));
  return settings.learning_rate * std::min(1.0, shape);
}

void limit_gradient(const std::vector<at::Tensor>& parameters) {
  double square = 0;
  for (const at::Tensor& p : parameters) square += p.grad().square().sum().item<double>();
  const double norm = std::sqrt(square);
  if (norm > kGradientLimit)
    for (const at::Tensor& p : parameters) p.grad().mul_(kGradientLimit / norm);
}

std::vector<double> to_list(const at::Tensor& x) {
  const at::Tensor plain = x.to(at::kDouble).contiguous();
  return {plain.data_ptr<double>(), plain.data_ptr<double>() + plain.numel()};
}

Indices images_of(const Indices& families, int family) {
  Indices images;
  for (const std::int64_t i : families)
    for (int member = 0; member < family; ++member) images.push_back(i * family + member);
  return images;
}

}  // namespace

double rank_correlation(const Student& student, const TrainingSet& set, const Indices& images) {
  const at::NoGradGuard no_grad;
  std::vector<std::vector<at::Tensor>> grams;  // [tap][image]
  for (const std::int64_t i : images) {
    const std::vector<at::Tensor> taps = student.grams(to_unit(set.images[i].unsqueeze(0)));
    grams.resize(taps.size());
    for (std::size_t tap = 0; tap < taps.size(); ++tap) grams[tap].push_back(taps[tap]);
  }
  std::vector<at::Tensor> distances;
  for (const auto& tap : grams) distances.push_back(relative_distances(at::cat(tap).to(at::kDouble)));
  return spearman(to_list(pairs_of(at::stack(distances).mean(0))),
                  to_list(teacher_distances(set, at::tensor(images, at::kLong)).mean(0)));
}

void train(Student& student, const std::vector<TrainingSet>& sets, const TrainingSettings& settings,
           const std::function<void(const TrainingReport&)>& report) {
  std::vector<Split> splits;
  for (const TrainingSet& set : sets)
    splits.push_back(split(set.images.size(0) / settings.family, settings.held_back));
  const std::vector<at::Tensor> parameters = student.parameters();
  torch::optim::Adam adam(parameters, torch::optim::AdamOptions(settings.learning_rate).eps(1e-8));
  Rng rng(settings.seed);
  // Larger images come in smaller batches, that a step takes as long.
  const auto batch_size = [&](const TrainingSet& set) {
    const double shrunk =
        static_cast<double>(sets[0].images.size(3)) / static_cast<double>(set.images.size(3));
    return std::max(std::min(settings.batch, kSmallestBatch),
                    static_cast<int>(settings.batch * shrunk * shrunk));
  };
  double loss_sum = 0, best = -1;
  int since = 0;
  for (int step = 0; step < settings.steps; ++step) {
    const auto s = static_cast<std::size_t>(rng.below(static_cast<int>(sets.size())));
    const at::Tensor batch =
        at::tensor(draw_batch(splits[s].training, settings, batch_size(sets[s]), rng), at::kLong);
    const at::Tensor error = loss(student_distances(student, to_unit(sets[s].images.index_select(0, batch))),
                                  teacher_distances(sets[s], batch));
    adam.zero_grad();
    error.backward();
    limit_gradient(parameters);
    static_cast<torch::optim::AdamOptions&>(adam.param_groups()[0].options())
        .lr(learning_rate(settings, step));
    adam.step();
    loss_sum += error.item<double>();
    ++since;
    if ((step + 1) % settings.report_every != 0 && step + 1 != settings.steps) continue;
    TrainingReport made{step + 1, loss_sum / std::exchange(since, 0), {}, false};
    loss_sum = 0;
    for (std::size_t i = 0; i < sets.size(); ++i)
      made.rank_correlation.push_back(
          rank_correlation(student, sets[i], images_of(splits[i].held_back, settings.family)));
    const double mean = std::reduce(made.rank_correlation.begin(), made.rank_correlation.end()) /
                        static_cast<double>(sets.size());
    made.best = mean > best;
    best = std::max(best, mean);
    report(made);
  }
}

}  // namespace patina
