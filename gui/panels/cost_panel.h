#pragma once

#include <optional>
#include <string>

#include "gui/panels/panel.h"
#include "gui/plot/cost_chart.h"

namespace patina {

/// Speed against accuracy, in a box over the window: what the run's draws have cost so far, where its way of
/// drawing lies on the chart of its material, and what a cheaper or a better answer would cost.
class CostPanel {
 public:
  void open() { open_ = true; }
  void close() { open_ = false; }
  bool visible() const { return open_; }

  /// For the run that is open, or the material that is chosen.
  void draw(const PanelContext& context);

  const std::optional<CostChart>& chart() const { return chart_; }

 private:
  void follow(const std::string& material);

  bool open_ = false;
  std::string material_;  ///< of what follows
  std::optional<CostChart> chart_;
  std::string problem_;  ///< why it could not be read
};

}  // namespace patina
