#include "gui/app.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <utility>

#include "gui/panels/chains_panel.h"
#include "gui/panels/draw_panel.h"
#include "gui/panels/help_sheet.h"
#include "gui/panels/top_bar.h"
#include "gui/window/look.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

/// Between frames for new draws alone: a draw is on the screen within a tenth of a second of being made, and
/// the sampler keeps its cores.
constexpr auto kDrawInterval = std::chrono::milliseconds(75);

std::filesystem::path home() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? home : "/";
}

}  // namespace

App::App(Window& window, RunFactory factory, const std::filesystem::path& runs,
         const std::filesystem::path& preferences)
    : window_(window),
      preferences_file_(preferences),
      draw_news_([&window] { window.wake(1); }, kDrawInterval),
      session_(std::move(factory), runs, [this] { draw_news_.note(); }),
      previews_([&window] { window.wake(); }),
      exporter_([&window] { window.wake(); }),
      photo_loader_(
          [](const PhotoRequest& request) {
            return load_photo(request.file, {.crop = request.crop, .whole_side = Session::kWholeSide});
          },
          [&window] { window.wake(); }),
      run_loader_(session_.run_opener(), [&window] { window.wake(); }),
      photo_(window.gl()),
      preview_(window.gl()),
      scatter_(window.gl(), [&window] { window.wake(); }),
      actions_(make_actions()) {
  if (!preferences_file_.empty()) attempt([this] { preferences_ = read_preferences(preferences_file_); });
  saved_preferences_ = preferences_;
  dialog_.start_in(preferences_.last_folder);
}

App::~App() {
  if (preferences_ != saved_preferences_) save_preferences();
}

void App::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    banner_.show(ErrorBanner::Kind::error, error.what());
  }
}

void App::load(const std::filesystem::path& path) {
  session_.open(path);
  announce_opened();
}

double App::patience() const {
  if (scatter_.busy() || material_.table().behind()) return 0;
  if (scatter_.behind()) return 0.05;
  if (exporter_.busy()) return 0.1;
  if (ImGui::GetIO().WantTextInput) return 0.4;  // the cursor blinks
  if (preferences_ != saved_preferences_ && !preferences_file_.empty()) return 1;
  if (preview_.animated()) return 0.5 * kFlickerSeconds;
  if (session_.is_live()) return 0.5;
  return 3600;
}

void App::frame(double longest_wait) {
  if (!std::exchange(dressed_, true)) fonts_ = dress(window_, preferences_);
  window_.begin_frame(std::min(patience(), longest_wait));
  take_dropped_files();
  take_in_news();
  handle_keys();
  draw_panels();
  for (const auto& command : std::exchange(commands_, {})) attempt(command);
  note_steps();
  attempt([this] { session_.save_stars(); });
  remember();
  window_.end_frame();
}

void App::take_in_news() {
  attempt([this] { session_.poll(); });
  attempt([this] {
    if (const auto preview = previews_.take()) preview_.show(*preview);
  });
  finish_loading();
  follow_crop();
  finish_export();
}

void App::finish_export() {
  const auto outcome = exporter_.take();
  if (!outcome) return;
  if (outcome->cancelled) {
    export_note_ = "Cancelled; what was done is in " + outcome->folder.string();
  } else if (outcome->error.empty()) {
    export_note_ = "Saved in " + outcome->folder.string();
  } else {
    export_note_.clear();
    banner_.show(ErrorBanner::Kind::error, outcome->error);
  }
}

void App::handle_escape() {
  if (palette_.visible()) {
    palette_.close();
  } else if (dialog_.visible()) {
    dialog_.close();
  } else if (file_choice_.visible()) {
    file_choice_.close();
  } else if (help_open_) {
    help_open_ = false;
  } else if (costs_.visible()) {
    costs_.close();
  } else if (scatter_.takes_keys() || photo_.takes_keys()) {
    give_keys_to_plot(false);
  } else if (banner_.visible()) {
    banner_.dismiss();
  } else if (!session_.model().marked().empty()) {
    session_.model().mark({}, Marking::replace);
  } else {
    session_.model().select(std::nullopt);
  }
}

void App::give_keys_to_plot(bool given) {
  photo_.take_keys(session_, false);
  scatter_.take_keys(given);
}

void App::give_keys_to_photo(bool given) {
  scatter_.take_keys(false);
  photo_.take_keys(session_, given);
}

void App::handle_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  // While a note is typed, Esc only ends that.
  const bool in_panel = keyboard_.on();
  if (in_panel) give_keys_to_plot(false);
  if (keyboard_.follow()) return;
  const bool in_dialog =
      dialog_.visible() || palette_.visible() || file_choice_.visible() || help_open_ || costs_.visible();
  const bool escape =
      (in_dialog || !in_panel) && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  if (escape && (!io.WantTextInput || dialog_.visible() || palette_.visible())) handle_escape();
  if (io.WantTextInput || dialog_.visible() || file_choice_.visible() || palette_.visible()) return;
  const bool taken = in_panel || scatter_.takes_keys() || photo_.takes_keys();
  for (const Action& action : actions_) {
    const bool pressed = std::ranges::any_of(action.shortcuts, [&](const Shortcut& shortcut) {
      return shortcut.pressed(action.repeats) && !(taken && shortcut.navigates());
    });
    if (pressed && action.enabled()) attempt(action.run);
  }
}

void App::draw_panels() {
  const ImGuiIO& io = ImGui::GetIO();
  const float em = ImGui::GetFontSize();
  const PanelContext context{session_, commands_, fonts_.semibold};
  const ShownDraw shown = shown_draw(session_);
  const auto open_dialog = [this] { ask_to_open(); };
  drag_columns(io.DisplaySize, em, preferences_.shares);
  const Layout layout = lay_out(io.DisplaySize, preferences_.shares, em);

  ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, io.DisplaySize, theme::kWindow);
  draw_top_bar(context, layout.top_bar, preferences_.recent,
               {open_dialog, [this](const auto& file) { open(file); }, [this] { help_open_ = true; },
                [this] { palette_.open(); }});
  photo_.draw(context, layout.photo, loading(), open_dialog);
  preview_.draw(context, layout.preview, shown, photo_.compared(session_), previews_.problem(),
                previews_.waiting());
  scatter_.draw(
      context, layout.scatter,
      {[this](std::size_t draw) { ask_to_export_draw(draw); }, [this] { ask_to_export_starred(); }});
  material_.draw(context, layout.material, shown);
  draw_chains_panel(context, layout.chains, [this] { costs_.open(); });
  const auto exported = exporter_.busy() ? std::optional(exporter_.done()) : std::nullopt;
  draw_draw_panel(
      context, layout.draw, shown, {exported, export_note_}, [this] { ask_to_export(); },
      [this] { exporter_.cancel(); });
  draw_dialogs(context);
  // After the panels, so that a click is answered in the frame that saw it.
  const PreviewView& view = preview_.view();
  previews_.want(session_, shown_draw(session_), view.resolution, is_shape(view.subject));
  if (const auto held = scatter_.held())
    previews_.foresee(session_, selected_draw(session_.model().draws(), *held), view.resolution,
                      is_shape(view.subject));
}

void App::draw_dialogs(const PanelContext& context) {
  banner_.draw(context, ImGui::GetIO().DisplaySize);
  draw_help_sheet(context, actions_, help_open_);
  costs_.draw(context);
  if (palette_.visible()) {
    std::vector<Action> actions = actions_;
    std::ranges::move(recent_actions(), std::back_inserter(actions));
    palette_.draw(context, actions);
  }
  if (const auto file = file_choice_.draw(context)) commands_.push_back([this, file = *file] { open(file); });
  const auto chosen = dialog_.draw(context, export_form_);
  if (!chosen) return;
  if (dialog_.purpose() == FileDialog::Purpose::open) {
    commands_.push_back([this, path = *chosen] { open(path); });
  } else {
    commands_.push_back([this, path = *chosen] { start_export(path); });
  }
}

void App::ask_to_open() {
  const auto last = dialog_.folder();
  dialog_.show(FileDialog::Purpose::open, last.empty() ? home() : last, {});
}

void App::ask_to_export() {
  const ShownDraw shown = shown_draw(session_);
  ask_for_export_folder({{export_request(session_, shown), {}}}, export_name(session_, shown));
}

void App::ask_to_export_draw(std::size_t draw) {
  session_.model().select(draw);
  ask_to_export();
}

void App::ask_to_export_starred() {
  const ExplorerModel& model = session_.model();
  std::vector<ExportJob> jobs;
  for (const Star& star : model.stars()) {
    const auto draw = model.draw_of(star);
    if (!draw) continue;
    jobs.push_back(
        {export_request(session_, selected_draw(model.draws(), *draw)), place_name(model.draws(), *draw)});
  }
  if (!jobs.empty()) ask_for_export_folder(std::move(jobs), session_.photo_name() + "-starred");
}

void App::ask_for_export_folder(std::vector<ExportJob> jobs, const std::string& name) {
  if (exporter_.busy()) return;
  export_jobs_ = std::move(jobs);
  const auto last = dialog_.folder();
  dialog_.show(FileDialog::Purpose::export_folder, last.empty() ? home() : last, name);
}

void App::start_export(const std::filesystem::path& folder) {
  if (exporter_.busy()) return;
  for (ExportJob& job : export_jobs_) export_form_.complete(job.request);
  exporter_.start(export_jobs_, folder);
}

void App::star_shown() {
  if (const auto draw = shown_draw(session_).draw) {
    session_.model().toggle_star(*draw);
  } else {
    banner_.show(ErrorBanner::Kind::notice, "Only a draw can be starred: click one in the plot first.");
  }
}

}  // namespace patina
