// What can be taken back, and how.

#include <algorithm>

#include "gui/app.h"

namespace patina {
namespace {

/// Turns of the wheel that follow one another so soon are one gesture.
constexpr auto kWheelRests = std::chrono::milliseconds(600);

bool any_key_down() {
  return std::ranges::any_of(ImGui::GetIO().KeysDown, [](bool down) { return down; });
}

}  // namespace

void App::undo() {
  steps_.undo([this](Choices choices) {
    if (choices == Choices::next_run) return session_.choices().undo();
    if (choices == Choices::view) return view_history_ && view_history_->undo() && restore_view();
    if (!history_.undo()) return false;
    session_.model().restore(history_.now());
    return true;
  });
}

void App::redo() {
  steps_.redo([this](Choices choices) {
    if (choices == Choices::next_run) return session_.choices().redo();
    if (choices == Choices::view) return view_history_ && view_history_->redo() && restore_view();
    if (!history_.redo()) return false;
    session_.model().restore(history_.now());
    return true;
  });
}

ViewChoices App::view_choices() const {
  PreviewView preview = preview_.view();
  preview.light = PreviewView().light;
  return {preview,
          scatter_.shown(),
          photo_.shows_clipped(),
          photo_.shows_seen(),
          preferences_.shares,
          preferences_.scale,
          preferences_.light_theme};
}

bool App::restore_view() {
  const ViewChoices& view = view_history_->now();
  const auto light = preview_.view().light;
  preview_.view() = view.preview;
  preview_.view().light = light;
  scatter_.show(view.draws);
  photo_.show_clipped(view.clipped);
  photo_.show_seen(view.seen);
  preferences_.shares = view.shares;
  dressed_ &= preferences_.scale == view.scale && preferences_.light_theme == view.light_theme;
  preferences_.scale = view.scale;
  preferences_.light_theme = view.light_theme;
  return true;
}

void App::note_steps() {
  if (history_run_ != session_.run_version()) {
    history_ = History<ExplorerChoices>(session_.model().choices());
    history_run_ = session_.run_version();
  }
  if (!view_history_) view_history_.emplace(view_choices());
  // A gesture is one step, however much it changes on its way.
  if (!ImGui::IsAnyMouseDown() && !any_key_down()) {
    const bool wheel = ImGui::GetIO().MouseWheel != 0;
    const auto now = std::chrono::steady_clock::now();
    const bool turns_on = wheel && now - wheeled_at_ < kWheelRests;
    if (wheel) wheeled_at_ = now;
    const auto note = [&](auto& history, const auto& choices) {
      if (choices != history.now()) history.change(choices, !turns_on);
    };
    note(history_, session_.model().choices());
    note(*view_history_, view_choices());
  }
  steps_.note({{Choices::draws, history_.steps()},
               {Choices::next_run, session_.choices().steps()},
               {Choices::view, view_history_->steps()}});
}

}  // namespace patina
