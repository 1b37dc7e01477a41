#pragma once

#include <string>

#include "gui/gl/surface_renderer.h"
#include "gui/panels/panel.h"
#include "gui/shown_draw.h"

namespace patina {

/// The render of the draw that is shown, at the photo's scale. Dragging wipes between photo and render.
class PreviewPanel {
 public:
  explicit PreviewPanel(const Gl& gl) : renderer_(gl) {}

  /// Takes in new maps. @throws UserError if the device cannot hold them
  void show(const MaterialMaps& maps);

  /// @param photo    to wipe to; may be null
  /// @param problem  why there is no render; empty if all is well
  /// @param waiting  a newer render is on its way
  void draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown, const Texture* photo,
            const std::string& problem, bool waiting);

  int resolution() const { return resolution_; }  ///< pixels a side that are wanted

  bool has_render() const { return renderer_.has_maps(); }
  Image render() const { return renderer_.read(); }  ///< what is shown, 3 channels in [0,1]

 private:
  void draw_wipe(const Rect& square, const Texture& photo) const;

  SurfaceRenderer renderer_;
  int resolution_ = 512;
};

}  // namespace patina
