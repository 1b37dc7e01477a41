#include <algorithm>
#include <iterator>

#include "engine/material/registry.h"
#include "gui/app.h"
#include "gui/panels/panel.h"
#include "gui/words.h"

namespace patina {

std::vector<Action> App::make_actions() {
  std::vector<Action> actions = file_actions();
  for (auto more :
       {run_actions(), material_actions(), draw_actions(), plot_actions(), preview_actions(), view_actions()})
    actions.insert(actions.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return actions;
}

std::vector<Action> App::file_actions() {
  return {
      {"Files",
       "Open a photo or a run",
       {Shortcut::letter('O', ImGuiKeyModFlags_Ctrl)},
       [this] { ask_to_open(); }},
      {"Files",
       "Open the photo or run whose path was copied",
       {Shortcut::letter('V', ImGuiKeyModFlags_Ctrl)},
       [this] { paste_path(); }},
      {"Files",
       "Export the draw that is shown",
       {Shortcut::letter('E', ImGuiKeyModFlags_Ctrl)},
       [this] { ask_to_export(); },
       [this] { return !exporter_.busy(); }},
      {"Files",
       "Undo",
       {Shortcut::letter('Z', ImGuiKeyModFlags_Ctrl)},
       [this] { undo(); },
       [this] { return steps_.can_undo(); }},
      {"Files",
       "Redo",
       {Shortcut::letter('Z', ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift),
        Shortcut::letter('Y', ImGuiKeyModFlags_Ctrl)},
       [this] { redo(); },
       [this] { return steps_.can_redo(); }},
      {"Files",
       "All commands by name",
       {Shortcut::letter('K', ImGuiKeyModFlags_Ctrl),
        Shortcut::letter('P', ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift)},
       [this] { palette_.open(); }},
      {"Files",
       "Help: mouse, keys and words",
       {Shortcut::character('?')},
       [this] { help_open_ = !help_open_; }},
  };
}

std::vector<Action> App::run_actions() {
  const auto can_pause = [this] { return session_.is_live() && session_.run().can_control(); };
  const auto pause_or_resume = [this] {
    session_.status().phase == RunPhase::paused ? session_.resume() : session_.pause();
  };
  return {
      {"Run", "Start a run", {}, [this] { session_.start(); }, [this] { return session_.has_photo(); }},
      {"Run",
       "Pause or resume the run",
       {Shortcut::named(ImGuiKey_Space, "Space")},
       pause_or_resume,
       can_pause},
      {"Run", "Stop the run", {}, [this] { session_.stop(); }, can_pause},
      {"Run",
       "Close the run; its photo stays",
       {},
       [this] { session_.close_run(); },
       [this] { return session_.has_run(); }},
      {"Run", "Continue the run", {}, [this] { session_.go_on(); }, [this] { return session_.can_go_on(); }},
      {"Run", "How fast, how sure: what draws cost", {}, [this] { costs_.open(); }},
  };
}

std::vector<Action> App::material_actions() {
  std::vector<Action> actions{{"Material",
                               "Material: find out which it is",
                               {},
                               [this] { session_.find_material(); },
                               [this] { return session_.has_photo() && session_.photo_is_current(); }}};
  for (const std::string& name : material_names())
    actions.push_back({"Material", "Material: " + capitalised(name), {}, [this, name] {
                         session_.choices().set_material(name);
                       }});
  return actions;
}

std::vector<Action> App::draw_actions() {
  const auto has_draws = [this] { return session_.model().draws().size() > 0; };
  return {
      {"Draws",
       "Next better draw",
       {Shortcut::named(ImGuiKey_LeftArrow, "Left")},
       [this] { session_.model().select_better(); },
       has_draws,
       true},
      {"Draws",
       "Next less likely draw",
       {Shortcut::named(ImGuiKey_RightArrow, "Right")},
       [this] { session_.model().select_worse(); },
       has_draws,
       true},
      {"Draws",
       "Best draw",
       {Shortcut::named(ImGuiKey_Home, "Home")},
       [this] { session_.model().select(session_.model().best()); },
       has_draws},
      {"Draws",
       "Star the draw that is shown, or take its star away",
       {Shortcut::letter('S')},
       [this] { star_shown(); },
       has_draws},
  };
}

std::vector<Action> App::plot_actions() {
  using Show = ScatterPanel::Show;
  const auto show = [this](Show what) { return [this, what] { scatter_.show(what); }; };
  const auto take = [this](MarkingTool tool) { return [this, tool] { scatter_.take(tool); }; };
  return {
      {"Plot", "One plot", {Shortcut::letter('P')}, show(Show::plot)},
      {"Plot", "All pairs", {Shortcut::letter('A')}, show(Show::pairs)},
      {"Plot", "Trace", {Shortcut::letter('T')}, show(Show::trace)},
      {"Plot", "Gallery", {Shortcut::letter('G')}, show(Show::gallery)},
      {"Plot", "Mark draws with a box", {Shortcut::letter('B')}, take(MarkingTool::box)},
      {"Plot", "Mark draws with a lasso", {Shortcut::letter('L')}, take(MarkingTool::lasso)},
      {"Plot",
       "Mark draws by keyboard: arrows, Enter sets corners, Esc ends",
       {Shortcut::letter('X')},
       [this] { give_keys_to_plot(!scatter_.takes_keys()); },
       [this] { return session_.has_run(); }},
      {"Plot",
       "Contours around half of the draws, and nine in ten",
       {Shortcut::letter('K')},
       [this] { session_.model().show_contours(!session_.model().shows_contours()); }},
      {"Plot",
       "What the marked draws range over",
       {Shortcut::letter('M')},
       [this] { scatter_.show_marked_ranges(); }},
  };
}

std::vector<Action> App::view_actions() {
  const auto scale = [this](float factor) {
    return [this, factor] {
      const float scaled = factor > 0 ? factor * preferences_.scale : 1;
      preferences_.scale = std::clamp(scaled, Preferences::kLeastScale, Preferences::kMostScale);
      dressed_ = false;
    };
  };
  const auto key = [](char letter) { return Shortcut::letter(letter, ImGuiKeyModFlags_Ctrl); };
  const auto go = [this](int panels) { return [this, panels] { keyboard_.go(panels); }; };
  return {
      {"Window",
       "To the next panel by keyboard; then arrows, Space presses, Esc leaves",
       {Shortcut::function(6)},
       go(1)},
      {"Window", "To the panel before", {Shortcut::function(6, ImGuiKeyModFlags_Shift)}, go(-1)},
      {"Window", "Larger text and panels", {key('=')}, scale(1.1f)},
      {"Window", "Smaller text and panels", {key('-')}, scale(1 / 1.1f)},
      {"Window", "Text and panels at their usual size", {key('0')}, scale(0)},
      {"Window",
       "Light or dark theme",
       {},
       [this] {
         preferences_.light_theme = !preferences_.light_theme;
         dressed_ = false;
       }},
  };
}

std::vector<Action> App::recent_actions() {
  std::vector<Action> actions;
  for (const std::filesystem::path& file : preferences_.recent)
    actions.push_back({"Files", "Open again: " + file.filename().string(), {}, [this, file] { open(file); }});
  return actions;
}

std::vector<Action> App::preview_actions() {
  std::vector<Action> actions;
  PreviewView& view = preview_.view();
  const auto has_photo = [this] { return session_.has_photo(); };
  actions.push_back({"Photo",
                     "Mark what is too bright",
                     {Shortcut::letter('C')},
                     [this] { photo_.show_clipped(!photo_.shows_clipped()); },
                     has_photo});
  actions.push_back({"Photo",
                     "Show the square as the run sees it",
                     {Shortcut::letter('V')},
                     [this] { photo_.show_seen(!photo_.shows_seen()); },
                     has_photo});
  actions.push_back({"Photo",
                     "Move the square by keyboard: arrows, + and -, Enter keeps it",
                     {Shortcut::letter('Q')},
                     [this] { give_keys_to_photo(!photo_.takes_keys()); },
                     [this] { return session_.has_photo() && !session_.photo().whole.empty(); }});
  actions.push_back({"Photo",
                     "Use the middle of the photo",
                     {},
                     [this] {
                       session_.crop_to(
                           central_crop(session_.photo().original_width, session_.photo().original_height));
                     },
                     has_photo});
  char digit = '1';
  for (const Subject subject : kSubjects) {
    actions.push_back({"Render",
                       std::string("Show: ") + subject_text(subject),
                       {Shortcut::character(digit++)},
                       [&view, subject] { view.subject = subject; }});
  }
  const auto compare = [&](const char* name, char key, Comparison comparison) {
    actions.push_back({"Render",
                       name,
                       {Shortcut::letter(key)},
                       [&view, comparison] { view.compare(comparison); },
                       has_photo});
  };
  compare("Render only", 'R', Comparison::off);
  compare("Wipe between photo and render", 'W', Comparison::wipe);
  compare("Photo and render side by side", 'N', Comparison::side_by_side);
  compare("Difference of photo and render", 'D', Comparison::difference);
  compare("Flicker between photo and render", 'F', Comparison::flicker);
  const auto expose = [&](const char* name, char key, float change) {
    actions.push_back({"Render",
                       name,
                       {Shortcut::character(key)},
                       [&view, change] { view.expose(change); },
                       [this] { return !photo_.takes_keys(); }});
  };
  expose("Brighter by half a stop", '+', 0.5f);
  expose("Darker by half a stop", '-', -0.5f);
  actions.push_back(
      {"Render", "Exposure as it was", {Shortcut::character('0')}, [&view] { view.stops = 0; }});
  return actions;
}

}  // namespace patina
