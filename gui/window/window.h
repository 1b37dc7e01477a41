#pragma once

#include <filesystem>
#include <vector>

#include "engine/image.h"
#include "gui/gl/functions.h"

namespace patina {

/// Where the program draws and what the user does there. A window owns the GL context and the Dear ImGui
/// context (and so the clipboard: ImGui::GetClipboardText()). One window at a time. All calls but wake() from
/// the thread that made it.
class Window {
 public:
  /// Dear ImGui answers some input, and lays out what is new, a frame or two later.
  static constexpr int kSettlingFrames = 3;

  virtual ~Window() = default;

  virtual const Gl& gl() const = 0;

  /// How much larger than at 96 dots per inch text and spacing should be, in ImGui's units.
  virtual float content_scale() const = 0;
  /// Framebuffer pixels per ImGui unit.
  virtual float pixel_density() const = 0;

  /// Sleeps until something happens or `timeout_seconds` have passed, then feeds ImGui's input and begins its
  /// frame (ImGui::NewFrame included). After input the next few frames follow without sleep, so that what
  /// input stirs up settles.
  virtual void begin_frame(double timeout_seconds) = 0;
  /// Draws what has been laid out since (ImGui::Render included) and shows it.
  virtual void end_frame() = 0;

  virtual bool should_close() const = 0;
  virtual void close() = 0;  ///< asks it to close

  /// Ends the sleep of begin_frame(). From any thread.
  /// @param frames  to be drawn without sleep in between; one is enough for what changes no panel's layout
  virtual void wake(int frames = kSettlingFrames) = 0;

  /// Files dropped since the last call.
  virtual std::vector<std::filesystem::path> take_dropped_files() = 0;

  virtual void set_title(const char* title) = 0;

  /// The last frame, 3 channels in [0,1], rows from the top. Between end_frame() and the next begin_frame().
  virtual Image screenshot() = 0;

 protected:
  Window() = default;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
};

}  // namespace patina
