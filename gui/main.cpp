#include <cstdio>
#include <exception>

#include "engine/allocator.h"
#include "engine/error.h"
#include "gui/arguments.h"
#include "gui/window/explorer_library.h"
#include "gui/window/glfw_window.h"
#include "gui/window/opening_screen.h"
#include "gui/window/preferences.h"

namespace patina {
namespace {

/// How the window was left; the app says what is wrong with the file.
Preferences left_preferences() {
  try {
    return read_preferences(preferences_file());
  } catch (const UserError&) {
    return {};
  }
}

/// Before a window opens: what is not there need not be looked for behind it.
void check_input(const std::filesystem::path& input) {
  std::error_code ignored;
  if (!input.empty() && !std::filesystem::exists(input, ignored))
    throw UserError("There is no " + input.string() + ": name a photo, or the directory of a run.");
}

void run_on_desktop(const Arguments& arguments) {
  const Preferences left = left_preferences();
  const auto window = make_glfw_window("Patina", arguments.width.value_or(left.width),
                                       arguments.height.value_or(left.height));
  OpeningScreen screen(*window, left, arguments.input.filename().string());
  screen.frame();
  // Not before: the driver is loaded as the window opens, and one library at a time is all that loads.
  ExplorerLibrary explorer;
  while (!explorer.ready() && !window->should_close()) screen.frame();
  if (!window->should_close()) explorer.get()(window.get(), arguments);
}

int run(int argc, char** argv) {
  try {
    const auto arguments = parse_arguments(argc, argv);
    if (!arguments) return 0;
    check_input(arguments->input);
    if (arguments->offscreen.empty())
      run_on_desktop(*arguments);
    else
      ExplorerLibrary().get()(nullptr, *arguments);
    return 0;
  } catch (const UserError& error) {
    std::fprintf(stderr, "patina: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "patina: %s\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) { return patina::run(argc, argv); }
