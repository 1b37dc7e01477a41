#include "gui/run_choices.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/error.h"
#include "engine/material/capture_priors.h"
#include "engine/material/registry.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kEdge = 1e-3;  // of a prior's range

/// @throws UserError unless it is a distribution that lies about its range
void check_prior(const std::string& name, const TruncatedNormal& prior) {
  const auto refuse = [&](const std::string& why) {
    throw UserError("What is assumed of " + parameter_label(name) + " cannot be: " + why);
  };
  if (!(prior.low < prior.high)) refuse("the lowest value must be below the highest.");
  if (!(prior.sd > 0) || !std::isfinite(prior.sd)) refuse("the spread must be above 0.");
  const double beyond = std::max(prior.low - prior.mean, prior.mean - prior.high);
  if (!(beyond < 5 * prior.sd)) refuse("the middle lies too far from the range for this spread.");
}

}  // namespace

RunChoices::RunChoices() : RunChoices(RunSettings()) { chose_material_ = false; }

RunChoices::RunChoices(RunSettings settings) : history_({std::move(settings), std::nullopt}) { refresh(); }

void RunChoices::refresh() {
  if (file_.material != settings().material) file_ = material_table(settings().material);
  material_ = table_under(file_, settings().capture);
  table_ = material_;
  for (const auto& [name, prior] : settings().priors)
    if (const auto index = table_.find_continuous(name)) table_.continuous[*index].prior = prior;
}

void RunChoices::change(RunSettings settings, bool new_gesture) {
  history_.change({std::move(settings), crop()}, new_gesture);
  refresh();
}

void RunChoices::set_material(const std::string& name) {
  suggest_material(name);
  chose_material_ = true;
}

bool RunChoices::material_is_chosen() const {
  return chose_material_ || !settings().fixed.empty() || !settings().priors.empty();
}

void RunChoices::suggest_material(const std::string& name) {
  material_table(name);  // throws before anything has changed
  if (name == settings().material) return;
  RunSettings changed = settings();
  changed.material = name;
  changed.summary.clear();
  changed.refresh.reset();
  changed.warmup.reset();
  changed.start = RunSettings().start;
  changed.start_at.clear();
  changed.fixed.clear();
  changed.priors.clear();
  change(std::move(changed), true);
}

void RunChoices::set_size_cm(double size_cm) {
  assert(size_cm > 0);
  Capture capture = settings().capture;
  capture.camera_cm *= size_cm / capture.size_cm;
  capture.size_cm = size_cm;
  set_capture(capture);
}

void RunChoices::set_capture(const Capture& capture, bool new_gesture) {
  RunSettings changed = settings();
  changed.capture = capture;
  change(std::move(changed), new_gesture);
}

void RunChoices::set_stop_rules(const StopRules& rules) {
  if (!(rules.minutes >= 0) || !(rules.ess >= 0) || !(rules.rhat >= 0))
    throw UserError("When a run ends is told by numbers from 0 up; 0 asks for nothing.");
  if (rules.rhat > 0 && rules.rhat <= 1)
    throw UserError("R-hat never falls to 1: ask for 1.01, or for 0 to leave it out.");
  RunSettings changed = settings();
  changed.stop = rules;
  change(std::move(changed), true);
}

void RunChoices::set_errors(const std::string& model) {
  RunSettings changed = settings();
  changed.errors = model;
  change(std::move(changed), true);
}

void RunChoices::set_crop(const PhotoCrop& crop, const Capture& capture) {
  RunSettings changed = settings();
  changed.capture = capture;
  history_.change({std::move(changed), crop}, true);
}

void RunChoices::begin_photo(const Capture& capture) {
  RunSettings changed = settings();
  changed.capture = capture;
  history_ = History<State>({std::move(changed), std::nullopt});
}

void RunChoices::hold_in(RunSettings& settings, const std::string& name, double value) const {
  if (const auto index = table_.find_continuous(name)) {
    const TruncatedNormal& prior = table_.continuous[*index].prior;
    settings.fixed[name] = std::clamp(value, prior.low, prior.high);
  } else if (const auto choice = table_.find_discrete(name)) {
    const auto last = static_cast<double>(table_.discrete[*choice].levels.size() - 1);
    settings.fixed[name] = std::clamp(std::round(value), 0.0, last);
  }
}

void RunChoices::lock(const std::string& name, double value) { hold({{name, value}}); }

void RunChoices::hold(const std::map<std::string, double>& values) {
  RunSettings changed = settings();
  for (const auto& [name, value] : values) hold_in(changed, name, value);
  change(std::move(changed), true);
}

void RunChoices::unlock(const std::string& name) {
  RunSettings changed = settings();
  changed.fixed.erase(name);
  change(std::move(changed), true);
}

void RunChoices::set_prior(const std::string& name, TruncatedNormal prior, bool new_gesture) {
  const auto index = material_.find_continuous(name);
  if (!index) return;
  const TruncatedNormal& own = material_.continuous[*index].prior;
  prior.low = std::clamp(prior.low, own.low, own.high);
  prior.high = std::clamp(prior.high, own.low, own.high);
  check_prior(name, prior);
  RunSettings changed = settings();
  changed.priors[name] = prior;
  if (prior == own) changed.priors.erase(name);
  if (const auto held = changed.fixed.find(name); held != changed.fixed.end())
    held->second = std::clamp(held->second, prior.low, prior.high);
  change(std::move(changed), new_gesture);
}

void RunChoices::reset_prior(const std::string& name) {
  RunSettings changed = settings();
  changed.priors.erase(name);
  change(std::move(changed), true);
}

ParameterValues RunChoices::typical() const {
  ParameterValues values = prior_location(table_);
  for (const auto& [name, value] : settings().fixed) {
    if (const auto index = table_.find_continuous(name)) values.continuous[*index] = value;
    if (const auto choice = table_.find_discrete(name)) values.discrete[*choice] = static_cast<int>(value);
  }
  return values;
}

RunSettings RunChoices::started_at(const ParameterValues& values) const {
  RunSettings started = settings();
  started.start = "values";
  started.start_at.clear();
  for (std::size_t i = 0; i < table_.continuous.size(); ++i) {
    const TruncatedNormal& prior = table_.continuous[i].prior;
    // At the very ends a chain's own coordinates are infinite.
    const double edge = kEdge * (prior.high - prior.low);
    started.start_at[table_.continuous[i].name] =
        std::clamp(values.continuous[i], prior.low + edge, prior.high - edge);
  }
  for (std::size_t i = 0; i < table_.discrete.size(); ++i)
    started.start_at[table_.discrete[i].name] = values.discrete[i];
  return started;
}

bool RunChoices::undo() {
  const bool undone = history_.undo();
  refresh();
  return undone;
}

bool RunChoices::redo() {
  const bool redone = history_.redo();
  refresh();
  return redone;
}

bool RunChoices::differ_from(const RunSettings& run) const {
  const auto inferred = [](const RunSettings& s) {
    return std::tie(s.material, s.capture, s.errors, s.fixed, s.priors);
  };
  return inferred(run) != inferred(settings());
}

}  // namespace patina
