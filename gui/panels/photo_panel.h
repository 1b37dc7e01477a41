#pragma once

#include <functional>
#include <optional>

#include "gui/gl/objects.h"
#include "gui/panels/panel.h"

namespace patina {

/// The photo, as the run sees it: its central square.
class PhotoPanel {
 public:
  explicit PhotoPanel(const Gl& gl) : gl_(gl) {}

  /// @param ask_to_open  carried out as a command where the user asks for another photo
  void draw(const PanelContext& context, const Rect& rect, const std::function<void()>& ask_to_open);

  const Texture* picture() const { return picture_ ? &*picture_ : nullptr; }

 private:
  void draw_invitation(const PanelContext& context, const Rect& room,
                       const std::function<void()>& ask_to_open);

  const Gl& gl_;
  std::optional<Texture> picture_;
  int version_ = 0;  ///< of the photo in picture_
};

}  // namespace patina
