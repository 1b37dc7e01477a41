// How photos and runs come into the program.

#include <utility>

#include "gui/app.h"

namespace patina {

void App::open(const std::filesystem::path& path) {
  starts_when_ready_ = false;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    photo_loader_.cancel();
    run_loader_.start(path);
  } else {
    run_loader_.cancel();
    photo_loader_.start({path, std::nullopt});
  }
}

void App::open_and_start(const std::filesystem::path& path) {
  attempt([&] { open(path); });
  starts_when_ready_ = photo_loader_.busy();
}

void App::finish_loading() {
  finish_loading_photo();
  finish_loading_run();
  start_if_ready();
}

void App::start_if_ready() {
  if (!starts_when_ready_ || photo_loader_.busy() || session_.finder().busy()) return;
  starts_when_ready_ = false;
  attempt([this] { session_.start(); });
}

void App::finish_loading_run() {
  auto outcome = run_loader_.take();
  if (!outcome) return;
  if (!outcome->loaded) return banner_.show(ErrorBanner::Kind::error, outcome->error);
  session_.open_run(std::move(*outcome->loaded));
  announce_opened();
}

void App::finish_loading_photo() {
  auto outcome = photo_loader_.take();
  if (!outcome) return;
  const PhotoRequest& request = outcome->request;
  if (!outcome->loaded) {
    banner_.show(ErrorBanner::Kind::error, outcome->error);
    starts_when_ready_ = false;
    // Asked for once more, it would fail again.
    if (request.crop && session_.has_photo()) session_.crop_to(session_.photo().crop);
  } else if (!request.crop) {
    session_.open_photo(std::move(*outcome->loaded), request.file);
    announce_opened();
  } else if (request.file == session_.photo_file()) {
    session_.recrop(std::move(*outcome->loaded));
  }
}

void App::follow_crop() {
  const bool opens_another = run_loader_.busy() || (photo_loader_.busy() && !photo_loader_.request().crop);
  if (!opens_another && !session_.photo_is_current())
    photo_loader_.start({session_.photo_file(), session_.chosen_crop()});
}

void App::take_dropped_files() {
  auto files = window_.take_dropped_files();
  if (files.size() == 1) commands_.push_back([this, file = files.front()] { open(file); });
  if (files.size() > 1) file_choice_.ask(std::move(files));
}

void App::paste_path() {
  const char* text = ImGui::GetClipboardText();
  if (text != nullptr && *text != 0) open(typed_path(text, std::filesystem::current_path()));
}

void App::announce_opened() {
  preferences_.opened(session_.has_run() ? session_.run().directory()
                                         : std::filesystem::absolute(session_.photo_file()));
  banner_.dismiss();
  export_note_.clear();
  window_.set_title((session_.photo_name() + " \u2013 Patina").c_str());
  for (const std::string& warning : session_.photo().warnings)
    banner_.show(ErrorBanner::Kind::notice, warning);
}

}  // namespace patina
