#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "gui/gl/multisampled.h"
#include "gui/gl/objects.h"
#include "gui/gl/surface_textures.h"
#include "gui/preview/orbit.h"
#include "gui/preview/preview_view.h"

namespace patina {

/// How a shape is looked at.
struct ShapeView {
  Subject shape = Subject::sphere;
  Orbit orbit;
  Eigen::Vector3f light = {0, 0, 1};  ///< where it comes from, in the camera's frame
  float stops = 0;
  bool mirrored = true;  ///< copies of the maps are mirror images by turns; else they continue one another
  int copies = 1;        ///< of the maps across the shape
  int width = 0, height = 0;  ///< pixels
  bool operator==(const ShapeView&) const = default;
};

/// The maps on a plane, a ball or a cloth, under a light that can be moved.
class ShapeRenderer {
 public:
  /// @throws UserError if the shaders are missing or do not compile
  explicit ShapeRenderer(const Gl& gl);

  /// Draws into texture(); does nothing if it holds the very picture. @throws UserError
  void render(SurfaceTextures& maps, const ShapeView& view);

  const Texture& texture() const { return target_->texture(); }
  Image read() const { return target_->read(); }  ///< transparent beside the shape

 private:
  void send_mesh(Subject shape, int copies);
  void resize(int width, int height);
  void set_uniforms(const SurfaceTextures& maps, const ShapeView& view) const;

  const Gl& gl_;
  Program program_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  int index_count_ = 0;
  std::optional<std::pair<Subject, int>> mesh_;  ///< shape and copies of the vertices sent
  std::optional<MultisampledFramebuffer> solid_;
  std::optional<Framebuffer> target_;
  std::optional<std::pair<int, ShapeView>> drawn_;  ///< version of the maps, and how they were seen
};

}  // namespace patina
