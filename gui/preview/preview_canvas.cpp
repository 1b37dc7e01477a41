#include "gui/preview/preview_canvas.h"

#include <algorithm>
#include <cmath>

namespace patina {

PreviewCanvas::PreviewCanvas(const Gl& gl) : surface_(gl), maps_(gl), shape_(gl), comparer_(gl) {}

void PreviewCanvas::take(const Preview& preview) {
  surface_.set_maps(preview.maps);
  of_sample_ = !preview.request.tile;
  repeats_ = preview.repeats;
  sample_cm_ = preview.request.capture.size_cm;
  if (of_sample_) surface_.render();
}

const Texture* PreviewCanvas::picture(const PreviewView& view, int side) {
  if (is_shape(view.subject)) return shape_picture(view, side);
  if (is_map(view.subject)) return map_picture(view, side);
  return has_render() ? &exposed(surface_.texture(), view, side, 0) : nullptr;
}

const Texture* PreviewCanvas::map_picture(const PreviewView& view, int side) {
  if (surface_.textures().empty() || !of_sample_) return nullptr;
  const std::pair wanted(surface_.textures().version(), view.subject);
  if (wanted != drawn_map_ && !maps_.render(surface_.textures(), view.subject)) return nullptr;
  drawn_map_ = wanted;
  // Only colours have an exposure.
  return view.subject == Subject::base_color ? &exposed(maps_.texture(), view, side, 0) : &maps_.texture();
}

const Texture* PreviewCanvas::shape_picture(const PreviewView& view, int side) {
  SurfaceTextures& maps = surface_.textures();
  if (maps.empty()) return nullptr;
  const int copies = std::max(1, static_cast<int>(std::lround(sample_cm_ / maps.capture().size_cm)));
  shape_.render(maps, {view.subject, view.orbit, view.light, view.stops, !repeats_, copies, side, side});
  return &shape_.texture();
}

const Texture& PreviewCanvas::photo(const Texture& photo, const PreviewView& view, int side) {
  return exposed(photo, view, side, 1);
}

const Texture& PreviewCanvas::difference(const Texture& photo, const PreviewView& view, int side) {
  return comparer_.difference(surface_.texture(), photo, {view.stops, view.gain, view.signed_difference},
                              side);
}

const Texture& PreviewCanvas::exposed(const Texture& picture, const PreviewView& view, int side, int slot) {
  return view.stops == 0 ? picture : comparer_.exposed(picture, view.stops, side, slot);
}

}  // namespace patina
