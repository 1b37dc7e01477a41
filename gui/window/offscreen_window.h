#pragma once

#include <imgui.h>

#include <memory>
#include <string>

#include "gui/window/window.h"

namespace patina {

/// A window in memory, drawn in software by OSMesa: for tests and for pictures without a display. Input is
/// queued by the calls below and taken by begin_frame(), one event a frame, so that no press is lost. Every
/// frame advances ImGui's clock by 1/60 s.
class OffscreenWindow : public Window {
 public:
  /// @throws UserError if OSMesa gives no OpenGL 3.3
  static std::unique_ptr<OffscreenWindow> make(int width, int height);

  virtual void resize(int width, int height) = 0;

  virtual void move_mouse(float x, float y) = 0;
  virtual void press_mouse(ImGuiMouseButton button = ImGuiMouseButton_Left) = 0;
  virtual void release_mouse(ImGuiMouseButton button = ImGuiMouseButton_Left) = 0;
  virtual void scroll(float x, float y) = 0;  ///< lines, y > 0: away from the user
  /// A key is what ImGui::IsKeyPressed() takes, in both windows: the ASCII code of a capital letter, digit or
  /// space, and ImGui::GetKeyIndex(ImGuiKey_...) for the others.
  virtual void press_key(int key) = 0;
  virtual void release_key(int key) = 0;
  virtual void hold_modifiers(ImGuiKeyModFlags modifiers) = 0;
  virtual void type(const std::string& utf8) = 0;
  virtual void drop_files(std::vector<std::filesystem::path> files) = 0;

  /// Whether all queued input has been taken.
  virtual bool input_taken() const = 0;

  // What a hand does, in one word.
  void click(float x, float y, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void double_click(float x, float y);
  void drag(float x0, float y0, float x1, float y1, ImGuiMouseButton button = ImGuiMouseButton_Left);
  void tap_key(int key);
};

}  // namespace patina
