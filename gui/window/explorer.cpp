#include "gui/window/explorer.h"

#include <chrono>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "gui/app.h"
#include "gui/window/offscreen_window.h"

namespace patina {
namespace {

std::filesystem::path sample() { return data_directory() / "photos" / "sample_bump.png"; }

void explore_on_desktop(Window& window, const Arguments& arguments) {
  App app(window, {}, default_runs_directory(), preferences_file());
  if (!arguments.material.empty()) app.session().choices().set_material(arguments.material);
  const bool named = !arguments.input.empty();
  if (named || !arguments.material.empty() || !app.reopen())
    app.open_and_start(named ? arguments.input : sample());
  while (!window.should_close()) app.frame();
}

void explore_offscreen(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto window = OffscreenWindow::make(arguments.width.value_or(1280), arguments.height.value_or(800));
  App app(*window, {}, default_runs_directory());
  if (!arguments.material.empty()) app.session().choices().set_material(arguments.material);
  app.load(arguments.input.empty() ? sample() : arguments.input);
  if (!app.session().has_run()) app.start_when_ready();
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(arguments.seconds));
  do {
    app.frame(0.1);
  } while (Clock::now() < end);
  write_image(arguments.offscreen, window->screenshot());
}

}  // namespace
}  // namespace patina

void patina_explore(patina::Window* window, const patina::Arguments& arguments) {
  if (window != nullptr)
    patina::explore_on_desktop(*window, arguments);
  else
    patina::explore_offscreen(arguments);
}
