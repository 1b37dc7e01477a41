#pragma once

#include <map>
#include <optional>
#include <string>

#include "engine/io/photo.h"
#include "engine/run/run_settings.h"
#include "gui/history.h"

namespace patina {

/// What the user has chosen for the next run; every choice can be taken back. Where a function throws,
/// everything is as it was before.
class RunChoices {
 public:
  RunChoices();  ///< nobody has chosen anything
  explicit RunChoices(RunSettings settings);

  const RunSettings& settings() const { return history_.now().settings; }
  /// The part of the photo; none: the central square.
  const std::optional<PhotoCrop>& crop() const { return history_.now().crop; }
  /// The chosen material's parameters, with its own priors for the chosen geometry and with the chosen ones.
  const ParameterTable& material() const { return material_; }
  const ParameterTable& table() const { return table_; }

  /// The middle of what is assumed, with what is locked where it is held.
  ParameterValues typical() const;

  void set_material(const std::string& name);      ///< @throws UserError; locks and priors go
  void suggest_material(const std::string& name);  ///< likewise, but nobody has chosen it
  /// Whether a material was chosen, or something said of its parameters: no other one is to be suggested.
  bool material_is_chosen() const;
  void set_size_cm(double size_cm);  ///< keeps the field of view
  /// @throws UserError for rules that no run can reach (a sentence that says why)
  void set_stop_rules(const StopRules& rules);
  void set_errors(const std::string& model);  ///< see RunSettings::errors
  void set_capture(const Capture& capture, bool new_gesture = true);
  /// Another part of the photo, and the geometry that goes with it.
  void set_crop(const PhotoCrop& crop, const Capture& capture);
  /// Another photo: its geometry; the crop of the one before goes, and with it all steps back.
  void begin_photo(const Capture& capture);

  /// Holds a parameter at a value, clamped to its prior's range (of a discrete one: a level's index), or lets
  /// it go. Unknown names are passed over.
  void lock(const std::string& name, double value);
  void unlock(const std::string& name);
  /// As lock(), several as one step.
  void hold(const std::map<std::string, double>& values);
  bool locked(const std::string& name) const { return settings().fixed.contains(name); }

  /// Replaces a continuous parameter's prior; its range is cut to the material's own.
  /// @throws UserError for one that is no distribution (a sentence that says why)
  void set_prior(const std::string& name, TruncatedNormal prior, bool new_gesture);
  void reset_prior(const std::string& name);  ///< to the material's own

  bool can_undo() const { return history_.can_undo(); }
  bool can_redo() const { return history_.can_redo(); }
  std::ptrdiff_t steps() const { return history_.steps(); }  ///< see History
  bool undo();
  bool redo();

  /// The settings of a run whose chains all begin at these values, moved inside the chosen priors' ranges.
  /// @param values  in the order of table()
  RunSettings started_at(const ParameterValues& values) const;

  /// Whether a run with these settings infers something else than one with the choices: another material,
  /// geometry or error model, other priors or locks.
  bool differ_from(const RunSettings& run) const;

 private:
  struct State {
    RunSettings settings;
    std::optional<PhotoCrop> crop;
    bool operator==(const State&) const = default;
  };

  void hold_in(RunSettings& settings, const std::string& name, double value) const;
  void change(RunSettings settings, bool new_gesture);
  void refresh();

  History<State> history_;
  bool chose_material_ = true;
  ParameterTable file_, material_, table_;
};

}  // namespace patina
