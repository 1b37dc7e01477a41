// How long a user waits for the first draw in the plot, from the start of the process: bench-first_draw
// [PHOTO] [MATERIAL]; without a material, for what it is at a glance, too
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "engine/allocator.h"
#include "engine/io/file.h"
#include "engine/io/temporary_folder.h"
#include "gui/app.h"
#include "gui/window/offscreen_window.h"

namespace patina {
namespace {

/// Loading the libraries included: from the kernel's start time of this process.
double seconds_since_process_start() {
  double uptime = 0;
  std::ifstream("/proc/uptime") >> uptime;
  std::ifstream stat("/proc/self/stat");
  std::string field;
  std::getline(stat, field, ')');
  for (int i = 3; i <= 22; ++i) stat >> field;  // proc(5): starttime is the 22nd field
  return uptime - std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

void wait_for(App& app, const char* what, auto&& holds) {
  while (!holds()) app.frame(0.02);
  app.frame(0);
  std::printf("%-34s %6.2f s\n", what, seconds_since_process_start());
  std::fflush(stdout);
}

void run(const std::filesystem::path& photo, const std::string& material) {
  const TemporaryFolder folder;
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, {}, folder.path() / "runs");
  if (!material.empty()) app.session().choices().set_material(material);
  app.load(photo);
  app.start_when_ready();
  const ExplorerModel& model = app.session().model();
  wait_for(app, "window with the photo", [] { return true; });
  wait_for(app, "run begun", [&] { return app.session().has_run(); });
  wait_for(app, "first render of a match",
           [&] { return app.session().status().best && app.preview().has_render(); });
  wait_for(app, "first draw in the plot (warm-up)", [&] { return model.draws().size() > 0; });
  wait_for(app, "first draw after warm-up", [&] { return model.draws().sampling_count() > 0; });
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  patina::run(argc > 1 ? argv[1] : patina::data_directory() / "photos" / "sample_bump.png",
              argc > 2 ? argv[2] : "");
}
