#include "gui/gl/point_renderer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "gui/gl/imgui_renderer.h"

namespace patina {
namespace {

/// What the device sees of a point.
struct Vertex {
  float x, y;           ///< pixels from the top left corner
  std::uint32_t color;  ///< opacity already lowered where dimmed
};

constexpr float kDimmedPointOpacity = 0.25f;
constexpr int kTileSide = 64;  // pixels

int tiles_across(int pixels) { return (pixels + kTileSide - 1) / kTileSide; }

std::uint32_t dimmed(std::uint32_t color) {
  const auto alpha =
      static_cast<std::uint32_t>(std::lround(kDimmedPointOpacity * static_cast<float>(color >> 24)));
  return (color & 0x00ffffffu) | alpha << 24;
}

/// The points that touch the picture, in pixels.
std::vector<Vertex> to_pixels(std::span<const PlotPoint> points, const PlotWindow& window, int width,
                              int height, float margin) {
  const double x_scale = width / (window.x_high - window.x_low);
  const double y_scale = height / (window.y_high - window.y_low);
  std::vector<Vertex> vertices;
  vertices.reserve(points.size());
  for (const PlotPoint& point : points) {
    const double x = (point.x - window.x_low) * x_scale, y = (window.y_high - point.y) * y_scale;
    const bool near = x > -margin && x < width + margin && y > -margin && y < height + margin;
    if (!near) continue;
    vertices.push_back(
        {static_cast<float>(x), static_cast<float>(y), point.dimmed ? dimmed(point.color) : point.color});
  }
  return vertices;
}

}  // namespace

PointRenderer::PointRenderer(const Gl& gl, const PointStyle& style)
    : gl_(gl),
      style_(style),
      point_program_(Program::load(gl, "points", "points")),
      density_program_(Program::load(gl, "fullscreen", "density")),
      point_layout_(gl),
      empty_(gl),
      vertices_(gl, GL_ARRAY_BUFFER) {
  vertices_.bind();
  point_layout_.attribute(0, 2, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, x));
  point_layout_.attribute(1, 4, GL_UNSIGNED_BYTE, true, sizeof(Vertex), offsetof(Vertex, color));
}

void PointRenderer::set_view(const PlotWindow& window, int width, int height) {
  const bool resized = !target_ || target_->width() != width || target_->height() != height;
  if (!resized && window == window_) return;
  window_ = window;
  stale_ = true;
  if (!resized) return;
  target_.emplace(gl_, width, height, TextureFilter::nearest);
  tiles_.resize(static_cast<std::size_t>(tiles_across(width) * tiles_across(height)));
  density_picture_.reset();
}

void PointRenderer::set_style(const PointStyle& style) {
  if (style == style_) return;
  style_ = style;
  stale_ = true;
}

void PointRenderer::append(std::span<const PlotPoint> points) {
  const bool was_density = shows_density();
  points_.insert(points_.end(), points.begin(), points.end());
  if (shows_density() != was_density) stale_ = true;
}

void PointRenderer::clear() {
  points_.clear();
  stale_ = true;
}

bool PointRenderer::render() {
  assert(target_);
  if (!stale_ && drawn_ == points_.size()) return false;
  if (stale_) {
    drawn_ = 0;
    density_ = DensityGrid(window_, target_->width(), target_->height());
    target_->bind();
    gl_.ClearColor(0, 0, 0, 0);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
  }
  const auto fresh = std::span<const PlotPoint>(points_).subspan(drawn_);
  shows_density() ? draw_density(fresh) : draw_points(fresh);
  if (stale_ || shows_density())
    touch(0, 0, static_cast<float>(target_->width()), static_cast<float>(target_->height()));
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  drawn_ = points_.size();
  stale_ = false;
  return true;
}

void PointRenderer::draw_points(std::span<const PlotPoint> fresh) {
  const auto vertices = to_pixels(fresh, window_, target_->width(), target_->height(), style_.diameter);
  if (vertices.empty()) return;
  vertices_.assign(std::as_bytes(std::span(vertices)));
  target_->bind();
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  point_program_.use();
  gl_.Uniform2f(point_program_.location("extent"), static_cast<float>(target_->width()),
                static_cast<float>(target_->height()));
  gl_.Uniform1f(point_program_.location("diameter"), style_.diameter);
  point_layout_.bind();
  gl_.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertices.size()));
  gl_.Disable(GL_PROGRAM_POINT_SIZE);
  gl_.Disable(GL_BLEND);
  const float reach = 0.5f * style_.diameter + 1;
  for (const Vertex& at : vertices) touch(at.x - reach, at.y - reach, at.x + reach, at.y + reach);
}

void PointRenderer::draw_density(std::span<const PlotPoint> fresh) {
  for (const PlotPoint& point : fresh) {
    point.dimmed ? density_.add_dimmed(point.x, point.y) : density_.add(point.x, point.y, point.color);
  }
  const auto picture = density_picture(density_.cells(), style_.density_colours);
  const int columns = density_.cells().dimmed.width, rows = density_.cells().dimmed.height;
  if (density_picture_) {
    density_picture_->update(0, 0, columns, rows, picture);
  } else {
    density_picture_ = Texture::rgba8(gl_, columns, rows, picture, TextureFilter::linear);
  }
  target_->bind();
  gl_.Disable(GL_BLEND);
  density_program_.use();
  density_picture_->bind(0);
  gl_.Uniform1i(density_program_.location("picture"), 0);
  gl_.Uniform1f(density_program_.location("cell"), DensityGrid::kCellPixels);
  empty_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void PointRenderer::touch(float left, float top, float right, float bottom) {
  const int columns = tiles_across(target_->width()), rows = tiles_across(target_->height());
  const auto tile = [](float pixel, int count) {
    return std::clamp(static_cast<int>(pixel) / kTileSide, 0, count - 1);
  };
  for (int row = tile(top, rows); row <= tile(bottom, rows); ++row)
    for (int column = tile(left, columns); column <= tile(right, columns); ++column)
      tiles_[static_cast<std::size_t>(row * columns + column)] = target_->texture().imgui_id();
}

void PointRenderer::show(ImDrawList& list, ImVec2 top_left, ImVec2 bottom_right) const {
  const PremultipliedImages premultiplied(list);
  const int columns = tiles_across(target_->width()), rows = tiles_across(target_->height());
  const auto in_texture = [&](int column, int row) {
    return ImVec2{
        std::min(1.0f, static_cast<float>(column * kTileSide) / static_cast<float>(target_->width())),
        std::min(1.0f, static_cast<float>(row * kTileSide) / static_cast<float>(target_->height()))};
  };
  const auto on_screen = [&](ImVec2 uv) {
    return ImVec2{std::lerp(top_left.x, bottom_right.x, uv.x), std::lerp(top_left.y, bottom_right.y, uv.y)};
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const ImVec2 low = in_texture(column, row), high = in_texture(column + 1, row + 1);
      list.AddImage(tiles_[static_cast<std::size_t>(row * columns + column)], on_screen(low), on_screen(high),
                    low, high);
    }
  }
}

}  // namespace patina
