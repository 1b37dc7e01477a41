#include <chrono>
#include <cstdio>
#include <exception>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "gui/app.h"
#include "gui/arguments.h"
#include "gui/glfw_window.h"
#include "gui/offscreen_window.h"

// Renders and networks give back large buffers all the time; jemalloc keeps them, in huge pages, so that the
// next one costs no page faults.
extern "C" {
const char* malloc_conf = "dirty_decay_ms:-1,muzzy_decay_ms:-1,thp:always";
}

namespace patina {
namespace {

void begin(App& app, const Arguments& arguments) {
  if (!arguments.material.empty()) app.session().choices().set_material(arguments.material);
  const bool sample = arguments.input.empty();
  if (sample && arguments.material.empty() && app.reopen()) return;
  app.load(sample ? data_directory() / "photos" / "sample_bump.png" : arguments.input);
  if (!app.session().has_run()) app.session().start();
}

/// How the window was left; the app says what is wrong with the file.
Preferences left_preferences() {
  try {
    return read_preferences(preferences_file());
  } catch (const UserError&) {
    return {};
  }
}

void run_on_desktop(const Arguments& arguments) {
  const Preferences left = left_preferences();
  const auto window = make_glfw_window("Patina", arguments.width.value_or(left.width),
                                       arguments.height.value_or(left.height));
  App app(*window, {}, default_runs_directory(), preferences_file());
  begin(app, arguments);
  while (!window->should_close()) app.frame();
}

void run_offscreen(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto window = OffscreenWindow::make(arguments.width.value_or(1280), arguments.height.value_or(800));
  App app(*window, {}, default_runs_directory());
  begin(app, arguments);
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(arguments.seconds));
  do {
    app.frame(0.1);
  } while (Clock::now() < end);
  write_image(arguments.offscreen, window->screenshot());
}

int run(int argc, char** argv) {
  try {
    const auto arguments = parse_arguments(argc, argv);
    if (!arguments) return 0;
    arguments->offscreen.empty() ? run_on_desktop(*arguments) : run_offscreen(*arguments);
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
