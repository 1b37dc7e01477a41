#pragma once

#include <map>
#include <optional>
#include <string>

#include "gui/panels/panel.h"

namespace patina {

/// How far the search for the photo's material is, and what it came to: how likely every material is, to
/// choose from. Takes a line, or none while there is nothing to tell.
class MaterialHint {
 public:
  void draw(const PanelContext& context);

  /// Where a material to choose was in the last frame.
  std::optional<ImVec2> place_of(const std::string& material) const;

 private:
  void draw_material(const PanelContext& context, const RankedMaterial& material);
  void draw_result(const PanelContext& context, const MaterialRanking& ranking);

  std::map<std::string, ImVec2> places_;
  int version_ = 0;  ///< of the last result; one that was waited for is shown by itself
};

}  // namespace patina
