// How the program is left and found again.

#include <utility>

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
  if (!awaited_draw_) {
    const DrawColumns& draws = session_.model().draws();
    const auto selected = session_.model().selected();
    preferences_.draw.reset();
    if (selected) preferences_.draw = {draws.chain(*selected), draws.iteration(*selected)};
  }
  const bool idle = !ImGui::IsAnyMouseDown() && std::chrono::steady_clock::now() - saved_at_ > kBetweenSaves;
  if (idle && preferences_ != saved_preferences_) save_preferences();
}

bool App::reopen() {
  if (preferences_.last_run.empty() || !looks_like_run(preferences_.last_run)) return false;
  const auto draw = preferences_.draw;
  attempt([this] { load(std::filesystem::path(preferences_.last_run)); });
  if (!session_.has_run()) return false;
  awaited_draw_ = draw;
  looked_at_ = 0;
  return true;
}

void App::restore_draw() {
  if (!awaited_draw_) return;
  ExplorerModel& model = session_.model();
  const auto found = model.draws().find(awaited_draw_->chain, awaited_draw_->iteration,
                                        std::exchange(looked_at_, model.draws().size()));
  if (found) model.select(found);
  if (found || model.selected() || !session_.has_run()) awaited_draw_.reset();
}

}  // namespace patina
