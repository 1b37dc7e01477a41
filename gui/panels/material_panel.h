#pragma once

#include <string>
#include <vector>

#include "gui/panels/material_hint.h"
#include "gui/panels/panel.h"
#include "gui/panels/parameter_table.h"
#include "gui/preview/shown_draw.h"

namespace patina {

/// Choice of material and size, the start of a run, and what is known of every parameter.
class MaterialPanel {
 public:
  MaterialPanel();
  void draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown);
  const MaterialHint& hint() const { return hint_; }
  const ParameterTableView& table() const { return table_; }

 private:
  void draw_choices(const PanelContext& context);
  void draw_start(const PanelContext& context, const ShownDraw& shown);
  void draw_advice(const PanelContext& context);

  std::vector<std::string> materials_;
  MaterialHint hint_;
  ParameterTableView table_;
};

}  // namespace patina
