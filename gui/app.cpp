#include "gui/app.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <utility>

#include "gui/panels/chains_panel.h"
#include "gui/panels/help_sheet.h"
#include "gui/panels/top_bar.h"
#include "gui/theme.h"
#include "gui/wake_limiter.h"

namespace patina {
namespace {

constexpr float kFontSize = 15;                                 // at 96 dots per inch
constexpr auto kDrawInterval = std::chrono::milliseconds(100);  // between frames for new draws alone

Fonts dressed(const Window& window) {
  const float size = std::round(kFontSize * window.content_scale());
  theme::apply(size);
  return load_fonts(size, window.pixel_density());
}

std::filesystem::path home() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home == '/' ? home : "/";
}

ExportRequest export_request(const PreviewRequest& picture) {
  return {picture.material, picture.z_seed, picture.capture, picture.values, picture.resolution};
}

/// "chain2-step1405": a draw's place in the run, for names of files.
std::string place_name(const DrawColumns& draws, std::size_t draw) {
  return "chain" + std::to_string(draws.chain(draw) + 1) + "-step" +
         std::to_string(draws.iteration(draw) + 1);
}

}  // namespace

App::App(Window& window, RunFactory factory, const std::filesystem::path& runs)
    : window_(window),
      fonts_(dressed(window)),
      session_(std::move(factory), runs, limited_wake([&window] { window.wake(); }, kDrawInterval)),
      previews_([&window] { window.wake(); }),
      photo_(window.gl()),
      preview_(window.gl()),
      scatter_(window.gl(), [&window] { window.wake(); }) {}

void App::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    banner_.show(ErrorBanner::Kind::error, error.what());
  }
}

void App::load(const std::filesystem::path& path) {
  session_.open(path);
  banner_.dismiss();
  export_note_.clear();
  window_.set_title((session_.photo_name() + " \u2013 Patina").c_str());
  for (const std::string& warning : session_.photo().warnings)
    banner_.show(ErrorBanner::Kind::notice, warning);
}

double App::patience() const {
  if (scatter_.busy()) return 0;
  if (exporter_.busy()) return 0.1;
  if (ImGui::GetIO().WantTextInput) return 0.4;  // the cursor blinks
  if (session_.is_live()) return 0.5;
  return 3600;
}

void App::frame(double longest_wait) {
  window_.begin_frame(std::min(patience(), longest_wait));
  for (const auto& file : window_.take_dropped_files()) commands_.push_back([this, file] { load(file); });
  take_in_news();
  handle_keys();
  draw_panels();
  for (const auto& command : std::exchange(commands_, {})) attempt(command);
  note_step();
  attempt([this] { session_.save_stars(); });
  window_.end_frame();
}

void App::take_in_news() {
  attempt([this] { session_.poll(); });
  attempt([this] {
    if (const auto preview = previews_.take()) preview_.show(preview->maps);
  });
  finish_export();
}

void App::finish_export() {
  const auto outcome = exporter_.take();
  if (!outcome) return;
  if (outcome->error.empty()) {
    export_note_ = "Saved in " + outcome->folder.string();
  } else {
    export_note_.clear();
    banner_.show(ErrorBanner::Kind::error, outcome->error);
  }
}

void App::handle_escape() {
  if (dialog_.visible()) {
    dialog_.close();
  } else if (help_open_) {
    help_open_ = false;
  } else if (banner_.visible()) {
    banner_.dismiss();
  } else if (!session_.model().marked().empty()) {
    session_.model().mark({}, Marking::replace);
  } else {
    session_.model().select(std::nullopt);
  }
}

void App::undo() {
  if (history_run_ == session_.run_version() && history_.undo()) session_.model().restore(history_.now());
}

void App::redo() {
  if (history_run_ == session_.run_version() && history_.redo()) session_.model().restore(history_.now());
}

void App::note_step() {
  const ExplorerChoices& choices = session_.model().choices();
  if (history_run_ != session_.run_version()) {
    history_ = History<ExplorerChoices>(choices);
    history_run_ = session_.run_version();
  }
  // A gesture is one step, however much it changes on its way.
  const ImGuiIO& io = ImGui::GetIO();
  const bool key_down = std::ranges::any_of(io.KeysDown, [](bool down) { return down; });
  if (!ImGui::IsAnyMouseDown() && !key_down) history_.change(choices, true);
}

void App::handle_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](ImGuiKey key, bool repeat) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };
  // While a note is typed, Esc only ends that.
  if (pressed(ImGuiKey_Escape, false) && (!io.WantTextInput || dialog_.visible())) handle_escape();
  if (io.WantTextInput || dialog_.visible()) return;
  if (io.KeyCtrl && ImGui::IsKeyPressed('O', false)) ask_to_open();
  if (io.KeyCtrl && ImGui::IsKeyPressed('E', false)) ask_to_export();
  if (io.KeyCtrl && ImGui::IsKeyPressed('Z')) io.KeyShift ? redo() : undo();
  if (io.KeyCtrl && ImGui::IsKeyPressed('Y')) redo();
  if (io.InputQueueCharacters.contains(static_cast<ImWchar>('?'))) help_open_ = !help_open_;
  if (!io.KeyCtrl && ImGui::IsKeyPressed('S', false)) star_shown();
  scatter_.handle_keys(session_.model());
  if (pressed(ImGuiKey_LeftArrow, true)) session_.model().select_better();
  if (pressed(ImGuiKey_RightArrow, true)) session_.model().select_worse();
  if (pressed(ImGuiKey_Space, false) && session_.is_live() && session_.run().can_control()) {
    session_.status().phase == RunPhase::paused ? session_.resume() : session_.pause();
  }
}

void App::draw_panels() {
  const ImGuiIO& io = ImGui::GetIO();
  const float em = ImGui::GetFontSize();
  const PanelContext context{session_, commands_, fonts_.semibold};
  const ShownDraw shown = shown_draw(session_);
  const std::string note = exporter_.busy() ? "Exporting..." : export_note_;
  const auto open_dialog = [this] { ask_to_open(); };
  drag_columns(io.DisplaySize, em, shares_);
  const Layout layout = lay_out(io.DisplaySize, shares_, em);

  ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, io.DisplaySize, theme::kWindow);
  draw_top_bar(context, layout.top_bar, open_dialog, [this] { help_open_ = true; });
  photo_.draw(context, layout.photo, open_dialog);
  preview_.draw(context, layout.preview, shown, photo_.picture(), previews_.problem(), previews_.waiting());
  scatter_.draw(
      context, layout.scatter,
      {[this](std::size_t draw) { ask_to_export_draw(draw); }, [this] { ask_to_export_starred(); }});
  material_.draw(context, layout.material, shown);
  draw_chains_panel(context, layout.chains);
  draw_.draw(context, layout.draw, shown, note, [this] { ask_to_export(); });
  draw_dialogs(context);
  // After the panels, so that a click is answered in the frame that saw it.
  previews_.want(session_, shown_draw(session_), preview_.resolution());
}

void App::draw_dialogs(const PanelContext& context) {
  banner_.draw(context, ImGui::GetIO().DisplaySize);
  draw_help_sheet(context, help_open_);
  const auto chosen = dialog_.draw(context);
  if (!chosen) return;
  if (dialog_.purpose() == FileDialog::Purpose::open) {
    commands_.push_back([this, path = *chosen] { load(path); });
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
  const PreviewRequest picture = preview_request(session_, shown, draw_.export_resolution());
  std::string name = picture.material;
  if (session_.has_photo()) name = session_.photo_name() + "-" + name;
  if (shown.draw) name += "-" + place_name(session_.model().draws(), *shown.draw);
  ask_for_export_folder({{export_request(picture), {}}}, name);
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
    const ShownDraw shown{ShownDraw::Kind::selected, draw, model.draws().lp(*draw),
                          model.draws().values(*draw)};
    jobs.push_back({export_request(preview_request(session_, shown, draw_.export_resolution())),
                    place_name(model.draws(), *draw)});
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
  if (!exporter_.busy()) exporter_.start(export_jobs_, folder);
}

void App::star_shown() {
  ExplorerModel& model = session_.model();
  if (const auto draw = shown_draw(session_).draw) {
    model.star(*draw, !model.starred(*draw));
  } else {
    banner_.show(ErrorBanner::Kind::notice, "Only a draw can be starred: click one in the plot first.");
  }
}

}  // namespace patina
