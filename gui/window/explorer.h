#pragma once

#include "gui/arguments.h"
#include "gui/window/window.h"

// The explorer, all that needs the engine, is a library of its own: the window is on the screen and answers
// while libtorch, which takes seconds to load, comes in behind it.
namespace patina {

/// Runs until the window is closed; without a window off screen, as the arguments say.
/// @throws UserError  std::exception if the program cannot go on
using Explore = void (*)(Window* window, const Arguments& arguments);

inline constexpr const char* kExploreName = "patina_explore";

}  // namespace patina

extern "C" void patina_explore(patina::Window* window, const patina::Arguments& arguments);
