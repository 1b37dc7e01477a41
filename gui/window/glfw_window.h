#pragma once

#include <memory>
#include <string>

#include "gui/window/window.h"

namespace patina {

/// A window on the desktop. @param width,height  at 96 dots per inch, grown by the screen's scale
/// @throws UserError if there is no display or no OpenGL 3.3
std::unique_ptr<Window> make_glfw_window(const std::string& title, int width, int height);

}  // namespace patina
