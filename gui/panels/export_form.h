#pragma once

#include "engine/run/export_draw.h"
#include "gui/panels/panel.h"

namespace patina {

/// How a draw is exported: kind of images, normal map, size, repeating or not; and what will be written.
class ExportForm {
 public:
  void draw();
  float height() const;  ///< in ImGui units

  /// Fills in what the form decides.
  void complete(ExportRequest& request) const;

 private:
  void draw_choices();
  void draw_files() const;

  MapFormat format_ = MapFormat::png16;
  NormalConvention normals_ = NormalConvention::opengl;
  int resolution_ = 1024;
  bool tile_ = false;
};

}  // namespace patina
