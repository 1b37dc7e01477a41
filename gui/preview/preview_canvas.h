#pragma once

#include "engine/run/preview_worker.h"
#include "gui/gl/map_renderer.h"
#include "gui/gl/picture_comparer.h"
#include "gui/gl/shape_renderer.h"
#include "gui/gl/surface_renderer.h"
#include "gui/preview/preview_view.h"

namespace patina {

/// The pictures of the draw that is shown, on the device: made from its maps as the view asks for them.
class PreviewCanvas {
 public:
  /// @throws UserError if shaders are missing
  explicit PreviewCanvas(const Gl& gl);

  /// Takes in new maps. @throws UserError if the device cannot hold them
  void take(const Preview& preview);

  bool has_render() const { return surface_.has_render(); }
  Image render() const { return surface_.read(); }  ///< as photographed, 3 channels in [0,1]

  /// What the view shows, the photo left out. Null: there is nothing to show (yet), or no such map.
  /// @param side  pixels of the square where it will be seen
  const Texture* picture(const PreviewView& view, int side);

  /// The photo at the view's exposure.
  const Texture& photo(const Texture& photo, const PreviewView& view, int side);

  /// Render against photo. Only where there is a picture as photographed.
  const Texture& difference(const Texture& photo, const PreviewView& view, int side);

 private:
  const Texture* map_picture(const PreviewView& view, int side);
  const Texture* shape_picture(const PreviewView& view, int side);
  const Texture& exposed(const Texture& picture, const PreviewView& view, int side, int slot);

  SurfaceRenderer surface_;
  MapRenderer maps_;
  ShapeRenderer shape_;
  PictureComparer comparer_;
  bool of_sample_ = false;  ///< the maps are the photographed sample's, not a tile
  bool repeats_ = false;
  double sample_cm_ = 1;
  std::pair<int, Subject> drawn_map_{0, Subject::base_color};  ///< version of the maps, and which one
};

}  // namespace patina
