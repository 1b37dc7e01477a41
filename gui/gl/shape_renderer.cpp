#include "gui/gl/shape_renderer.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "gui/preview/shape_mesh.h"

namespace patina {

ShapeRenderer::ShapeRenderer(const Gl& gl)
    : gl_(gl),
      program_(Program::load(gl, "shape", "shape")),
      layout_(gl),
      vertices_(gl, GL_ARRAY_BUFFER),
      indices_(gl, GL_ELEMENT_ARRAY_BUFFER) {}

void ShapeRenderer::send_mesh(Subject shape, int copies) {
  if (mesh_ == std::pair(shape, copies)) return;
  const ShapeMesh mesh = shape_mesh(shape, copies);
  layout_.bind();
  vertices_.assign(std::as_bytes(std::span(mesh.vertices)));
  indices_.assign(std::as_bytes(std::span(mesh.indices)));
  const auto attribute = [&](GLuint index, GLint components, std::size_t offset) {
    layout_.attribute(index, components, GL_FLOAT, false, sizeof(ShapeVertex), offset);
  };
  attribute(0, 3, offsetof(ShapeVertex, position));
  attribute(1, 3, offsetof(ShapeVertex, normal));
  attribute(2, 3, offsetof(ShapeVertex, tangent));
  attribute(3, 2, offsetof(ShapeVertex, place));
  index_count_ = static_cast<int>(mesh.indices.size());
  mesh_ = {shape, copies};
}

void ShapeRenderer::resize(int width, int height) {
  if (target_ && target_->width() == width && target_->height() == height) return;
  solid_.emplace(gl_, width, height);
  target_.emplace(gl_, width, height);
}

void ShapeRenderer::set_uniforms(const SurfaceTextures& maps, const ShapeView& view) const {
  const auto camera = static_cast<float>(maps.capture().camera_cm);
  const Eigen::Vector3f eye = view.orbit.eye(), to_light = view.orbit.frame() * view.light;
  const Eigen::Matrix4f projection = view.orbit.projection();
  gl_.UniformMatrix4fv(program_.location("projection"), 1, GL_FALSE, projection.data());
  gl_.Uniform3f(program_.location("eye"), eye.x(), eye.y(), eye.z());
  gl_.Uniform3f(program_.location("to_light"), to_light.x(), to_light.y(), to_light.z());
  gl_.Uniform1f(program_.location("light"), maps.light() / (camera * camera) * std::exp2(view.stops));
  gl_.Uniform1i(program_.location("mirrored"), view.mirrored);
  maps.bind(program_);
}

void ShapeRenderer::render(SurfaceTextures& maps, const ShapeView& view) {
  if (drawn_ == std::pair(maps.version(), view)) return;
  resize(view.width, view.height);
  send_mesh(view.shape, view.copies);
  maps.filter_beyond_edges(view.mirrored ? GL_MIRRORED_REPEAT : GL_REPEAT);
  solid_->bind();
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program_.use();
  set_uniforms(maps, view);
  layout_.bind();
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  gl_.Disable(GL_DEPTH_TEST);
  solid_->resolve_into(*target_);
  drawn_ = {maps.version(), view};
}

}  // namespace patina
