#include "engine/chart/setting.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "engine/run/emulated_proposals.h"
#include "engine/run/run_settings.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metric.h"
#include "engine/summary/summary_name.h"

namespace patina {
namespace {

constexpr int kQuickWarmup = 500;

/// The settings of a preset: the default, and hmc with one change each.
class Matrix {
 public:
  explicit Matrix(const ChartTarget& target)
      : target_(target),
        usual_(default_setting({.has_jagged = target.has_jagged})),
        settings_{default_setting(target)} {
    if (!target.can_emulate) return;
    if (target.can_average) settings_.push_back(by_hand(target));
    settings_.push_back(usual_);
    settings_.back().name = usual_.kernel;
  }

  template <typename T>
  void add(const std::string& name, T ChartSetting::*field, const T& value) {
    add(name, [&](ChartSetting& setting) { setting.*field = value; });
  }

  /// Left out if it changes nothing, or cannot be run on the target.
  void add(const std::string& name, const std::function<void(ChartSetting&)>& change) {
    ChartSetting setting = usual_;
    change(setting);
    if (setting.summary == target_.summary) setting.summary.clear();
    if (setting == usual_ || (target_.has_jagged && setting.refresh == 0)) return;
    setting.name = name;
    settings_.push_back(setting);
  }

  void add_refreshes(std::initializer_list<const char*> refreshes) {
    for (const char* refresh : refreshes)
      add(std::string("refresh ") + refresh, &ChartSetting::refresh, std::stod(refresh));
  }

  void add_resolution(int divisor) {
    const int resolution = target_.resolution / divisor;
    if (can_look_at(resolution))
      add(std::to_string(resolution) + " pixels", &ChartSetting::resolution, resolution);
  }

  void add_proposals(int divisor) {
    const int resolution = target_.resolution / divisor;
    if (can_look_at(resolution))
      add("proposed at " + std::to_string(resolution) + " pixels", &ChartSetting::proposals, resolution);
  }

  void add_levels(int levels) {
    if (levels < target_.levels)
      add(std::to_string(levels) + (levels == 1 ? " level" : " levels"), &ChartSetting::summary,
          with_levels(target_.summary, levels));
  }

  void add_calibrated() {
    if (target_.can_learn) add<std::string>("calibrated errors", &ChartSetting::errors, "calibrated");
  }

  void add_precision() {
    if (target_.can_round) add<std::string>("bfloat16", &ChartSetting::precision, "bfloat16");
  }

  std::vector<ChartSetting> settings() const { return settings_; }

 private:
  static ChartSetting by_hand(ChartTarget target) {
    target.can_average = false;
    ChartSetting setting = default_setting(target);
    setting.name = kHandSet;
    return setting;
  }

  bool can_look_at(int coarser) const {
    return coarser >= target_.least_resolution && coarser < target_.resolution;
  }

  ChartTarget target_;
  ChartSetting usual_;  ///< without emulated proposals, which leave nothing else to choose
  std::vector<ChartSetting> settings_;
};

void add_kernels_and_metrics(Matrix& matrix) {
  for (const std::string& kernel : kernel_names())
    for (const std::string& metric : metric_names())
      matrix.add(kernel + " " + metric, [&](ChartSetting& setting) {
        setting.kernel = kernel;
        setting.metric = metric;
      });
}

std::vector<ChartSetting> quick(const ChartTarget& target) {
  Matrix matrix(target);
  for (const char* kernel : {"mh", "mala", "nuts"})
    matrix.add<std::string>(kernel, &ChartSetting::kernel, kernel);
  matrix.add<std::string>("dense metric", &ChartSetting::metric, "dense");
  matrix.add_refreshes({"0.25", "0.75"});
  matrix.add("2 chains", &ChartSetting::chains, 2);
  matrix.add_resolution(2);
  matrix.add_proposals(2);
  matrix.add_levels(3);
  matrix.add_precision();
  matrix.add_calibrated();
  return with_warmup(matrix.settings(), kQuickWarmup);
}

std::vector<ChartSetting> full(const ChartTarget& target) {
  Matrix matrix(target);
  add_kernels_and_metrics(matrix);
  matrix.add_refreshes({"0", "0.25", "0.5", "0.75", "0.9"});
  for (const char* length : {"0.6", "3"})
    matrix.add(std::string("path ") + length, &ChartSetting::path_length, std::stod(length));
  for (const int chains : {1, 2, 8})
    matrix.add(std::to_string(chains) + (chains == 1 ? " chain" : " chains"), &ChartSetting::chains, chains);
  for (const int warmup : {300, 700, 1500, 3000})
    matrix.add("warm-up " + std::to_string(warmup), &ChartSetting::warmup, warmup);
  for (const int divisor : {2, 4}) matrix.add_resolution(divisor);
  for (const int divisor : {2, 4}) matrix.add_proposals(divisor);
  for (int levels = 1; levels < target.levels; ++levels) matrix.add_levels(levels);
  for (const char* summary : {"means", "rings", "gram"})
    matrix.add<std::string>(std::string(summary) + " alone", &ChartSetting::summary, summary);
  matrix.add<std::string>("start: prior", &ChartSetting::start, "prior");
  matrix.add_precision();
  matrix.add_calibrated();
  if (target.has_discrete) matrix.add<std::string>("single levels", &ChartSetting::discrete, "single");
  return matrix.settings();
}

}  // namespace

ChartSetting default_setting(const ChartTarget& target) {
  const RunSettings run;
  ChartSetting setting;
  setting.name = kDefaultSetting;
  setting.kernel = kernel_in_use(run, target.can_emulate);
  setting.metric = run.metric;
  setting.discrete = run.discrete;
  setting.start = run.start;
  setting.errors = target.can_average ? "averaged" : "paper";
  setting.precision = run.precision;
  setting.chains = run.chains;
  setting.warmup = run.warmup.value_or(usual_warmup(target.has_jagged && !target.can_emulate));
  setting.alpha = run.alpha;
  setting.refresh = run.refresh.value_or(usual_refresh(target.has_jagged));
  setting.path_length = run.path_length;
  return setting;
}

std::vector<std::string> chart_presets() { return {"quick", "full"}; }

std::vector<ChartSetting> preset_settings(const std::string& preset, const ChartTarget& target) {
  if (preset == "quick") return quick(target);
  if (preset == "full") return full(target);
  throw std::invalid_argument("unknown preset '" + preset + "'");
}

std::vector<ChartSetting> with_warmup(std::vector<ChartSetting> settings, int warmup) {
  std::vector<ChartSetting> result;
  for (ChartSetting& setting : settings) {
    setting.warmup = warmup;
    const bool is_there = std::ranges::any_of(result, [&](ChartSetting other) {
      other.name = setting.name;
      return other == setting;
    });
    if (!is_there) result.push_back(std::move(setting));
  }
  return result;
}

}  // namespace patina
