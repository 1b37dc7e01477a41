#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/run/summarize.h"
#include "gui/pace.h"
#include "gui/panels/panel.h"
#include "gui/panels/prior_editor.h"
#include "gui/plot/parameter_histograms.h"
#include "gui/preview/shown_draw.h"

namespace patina {

/// The parameters of the chosen material, a row each: a lock, the name, what is assumed with what the draws
/// say over it, posterior mean and sd, R-hat.
class ParameterTableView {
 public:
  void draw(const PanelContext& context, const ShownDraw& shown);

  /// Whether there are draws that the bars do not show yet.
  bool behind() const { return behind_; }

  /// Where a row's lock and curve were in the last frame, rows in the table's order.
  struct RowPlace {
    ImVec2 lock, curve;
  };
  const std::vector<RowPlace>& places() const { return places_; }
  const PriorEditor& editor() const { return editor_; }

 private:
  void follow(const Session& session);
  void draw_rows(const PanelContext& context, const ParameterValues& values);
  void draw_continuous(const PanelContext& context, std::size_t index, double value);
  void draw_discrete(const PanelContext& context, std::size_t index, int level);
  void draw_lock_and_name(const PanelContext& context, const std::string& name, double value,
                          const std::string& about);

  int run_version_ = -1;
  std::string material_;
  ParameterHistograms histograms_;
  Pace pace_;
  std::vector<PlotRange> ranges_;
  bool behind_ = false;
  bool has_bars_ = false;  ///< they are of the parameters in the table
  PriorEditor editor_;
  std::vector<RowPlace> places_;
};

}  // namespace patina
