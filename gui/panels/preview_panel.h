#pragma once

#include <string>

#include "gui/panels/panel.h"
#include "gui/preview/preview_canvas.h"
#include "gui/preview/preview_view.h"
#include "gui/preview/shown_draw.h"

namespace patina {

/// The draw that is shown: as photographed, alone or against the photo; on a lit shape; or one of its maps.
class PreviewPanel {
 public:
  explicit PreviewPanel(const Gl& gl) : canvas_(gl) {}

  /// Takes in new maps. @throws UserError if the device cannot hold them
  void show(const Preview& preview) { canvas_.take(preview); }

  /// @param photo    to compare with; may be null
  /// @param problem  why there is no render; empty if all is well
  /// @param waiting  a newer render is on its way
  void draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown, const Texture* photo,
            const std::string& problem, bool waiting);

  PreviewView& view() { return view_; }
  const PreviewView& view() const { return view_; }
  bool animated() const { return view_.effective_comparison() == Comparison::flicker; }

  bool has_render() const { return canvas_.has_render(); }
  Image render() const { return canvas_.render(); }  ///< as photographed, 3 channels in [0,1]

  /// Where the picture was in the last frame.
  const Rect& square() const { return square_; }

 private:
  void draw_title(const ShownDraw& shown, bool waiting);
  void draw_picture(const Rect& room, const Texture* photo);
  void draw_comparison(const Texture& render, const Texture* photo, int pixels);
  void draw_side_by_side(const Texture& render, const Texture& photo) const;
  void draw_wipe(const Texture& photo) const;
  void handle_mouse(bool can_compare);

  PreviewCanvas canvas_;
  PreviewView view_;
  Rect room_, square_;
};

}  // namespace patina
