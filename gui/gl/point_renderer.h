#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gui/gl/objects.h"
#include "gui/plot/density_picture.h"

namespace patina {

/// A point of a scatter plot.
struct PlotPoint {
  double x = 0, y = 0;      ///< data units
  std::uint32_t color = 0;  ///< as ImU32: red in the lowest byte, not premultiplied
  bool dimmed = false;      ///< fainter and beneath notice
};

struct PointStyle {
  float diameter = 4;  ///< pixels
  /// From this many points on a map of their density is shown instead: a plot is covered by then, and a
  /// processor that draws in software needs 20 ms for them.
  std::size_t density_above = 30'000;
  DensityColours density_colours = DensityColours::count;
  bool operator==(const PointStyle&) const = default;
};

/// The cloud of a scatter plot, kept in a texture: points that are appended are drawn on top of what is
/// there; all is redrawn only when the view changes. Points are taken to pixels in double, so that no zoom
/// makes them tremble.
class PointRenderer {
 public:
  /// @throws UserError if the shaders are missing or do not compile
  explicit PointRenderer(const Gl& gl, const PointStyle& style = {});

  /// Which part of the plane the texture shows, y upwards, and its size in pixels. Cheap if nothing changes.
  void set_view(const PlotWindow& window, int width, int height);
  void set_style(const PointStyle& style);

  void append(std::span<const PlotPoint> points);
  void clear();
  std::size_t size() const { return points_.size(); }

  /// Draws what is new, if anything; returns whether the texture changed. set_view() comes first.
  bool render();

  /// Adds the texture to a list, transparent where there is nothing. It is added in tiles, so that a frame
  /// with some points more differs from the last only around them.
  void show(ImDrawList& list, ImVec2 top_left, ImVec2 bottom_right) const;
  Image read() const { return target_->read(); }  ///< premultiplied

  bool shows_density() const { return points_.size() > style_.density_above; }
  /// Points in all cells of the density map: those in view.
  std::uint64_t density_total() const { return density_.total(); }

 private:
  void draw_points(std::span<const PlotPoint> fresh);
  void draw_density(std::span<const PlotPoint> fresh);
  void touch(float left, float top, float right, float bottom);  ///< has been drawn into

  const Gl& gl_;
  PointStyle style_;
  Program point_program_, density_program_;
  VertexArray point_layout_, empty_;
  Buffer vertices_;
  std::vector<PlotPoint> points_;
  std::size_t drawn_ = 0;  ///< points_[0, drawn_) are in the texture
  bool stale_ = true;      ///< all has to be drawn anew
  PlotWindow window_;
  DensityGrid density_;
  std::optional<Texture> density_picture_;
  std::optional<Framebuffer> target_;
  std::vector<ImTextureID> tiles_;  ///< the texture when each was drawn into last; rows from the top
};

}  // namespace patina
