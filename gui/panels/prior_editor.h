#pragma once

#include <string>

#include "gui/panels/panel.h"

namespace patina {

/// A small window in which what is assumed of one parameter before looking at the photo is changed.
class PriorEditor {
 public:
  /// Opens it at the next draw(), to the left of a point. @param parameter  a continuous one's name
  void open(const std::string& parameter, ImVec2 point);

  /// Where its fields were in the last frame, from the first to the last; meaningless before that.
  const Rect& fields() const { return fields_; }

  /// After the table whose parameter it edits.
  void draw(const PanelContext& context);

 private:
  /// One number of the prior, to be dragged or typed. @return whether it changed
  bool edit(const char* label, double& value, double span, const char* what);
  void draw_fields(const PanelContext& context, const Parameter& own, const Parameter& parameter);

  std::string parameter_;
  ImVec2 point_;
  Rect fields_;
  bool opens_ = false;
  bool new_gesture_ = true;  ///< the next change begins one
};

}  // namespace patina
