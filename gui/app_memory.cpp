// How the program is left and found again.

#include "gui/app.h"

namespace patina {
namespace {

constexpr auto kBetweenSaves = std::chrono::seconds(2);  // flushing to disk takes a while

}  // namespace

void App::save_preferences() {
  saved_preferences_ = preferences_;
  saved_at_ = std::chrono::steady_clock::now();
  if (!preferences_file_.empty()) attempt([this] { write_preferences(preferences_file_, preferences_); });
}

void App::remember() {
  const ImGuiIO& io = ImGui::GetIO();
  preferences_.width = static_cast<int>(io.DisplaySize.x);
  preferences_.height = static_cast<int>(io.DisplaySize.y);
  preferences_.last_folder = dialog_.folder();
  preferences_.last_run = session_.has_run() ? session_.run().directory() : std::filesystem::path();
  const ExplorerModel& model = session_.model();
  preferences_.draw = model.awaited();
  if (model.selected()) preferences_.draw = model.draws().where(*model.selected());
  const bool idle = !ImGui::IsAnyMouseDown() && std::chrono::steady_clock::now() - saved_at_ > kBetweenSaves;
  if (idle && preferences_ != saved_preferences_) save_preferences();
}

bool App::reopen() {
  if (preferences_.last_run.empty() || !looks_like_run(preferences_.last_run)) return false;
  const auto draw = preferences_.draw;
  attempt([this] { load(std::filesystem::path(preferences_.last_run)); });
  if (!session_.has_run()) return false;
  if (draw) session_.model().await(*draw);
  return true;
}

}  // namespace patina
