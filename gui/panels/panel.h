#pragma once

#include <imgui.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "gui/session.h"
#include "gui/window/layout.h"

namespace patina {

/// What the user asked for during a frame. Carried out after the frame has been laid out, so that whatever is
/// thrown never leaves Dear ImGui's stack half open.
using Commands = std::vector<std::function<void()>>;

/// What every panel sees.
struct PanelContext {
  Session& session;
  Commands& commands;
  ImFont* heading;  ///< semi-bold
};

/// A panel's ground and title, for as long as it lives. Of the title, what follows "##" only names the panel.
class PanelScope {
 public:
  PanelScope(const char* title, const Rect& rect, const PanelContext& context, ImGuiWindowFlags flags = 0);
  ~PanelScope();
  PanelScope(const PanelScope&) = delete;
  PanelScope& operator=(const PanelScope&) = delete;
};

/// A box over the middle of the window that takes all input, while `visible`.
/// @param em  its size, cut to the window's
/// @return whether it is there, to be filled and ended by ImGui::EndPopup()
bool begin_box(const char* name, bool visible, ImVec2 em);

/// Text in the heading's font.
void heading_text(const PanelContext& context, const std::string& text);

/// Text in the muted colour, wrapped at the panel's edge.
void muted_text(const std::string& text);

/// One line of text, its middle left out where it is too long for `width`; the whole in a tooltip then.
void elided_text(const std::string& text, float width, ImU32 color);

/// The same where there is more to say: `more` in a tooltip, always.
void elided_text(const std::string& text, float width, ImU32 color, const std::string& more);

/// Whether the mouse is still where it clicked: whoever clicked knows, and wants to see what came of it.
bool mouse_rests_after_click();

/// A tooltip for the item before, in a box of readable width; not while mouse_rests_after_click().
void tooltip(const std::string& text);

/// A button in the accent colour: what to do next.
bool primary_button(const char* label, ImVec2 size = {0, 0});

/// A button that shows what is drawn over it, and whether the keys are on it.
bool picture_button(const char* id, ImVec2 size);

/// Where the mouse draws, drags and clicks; keys pass it over.
void mouse_area(const char* id, ImVec2 size, ImGuiButtonFlags buttons = ImGuiButtonFlags_MouseButtonLeft);

/// One of a few buttons of which one is on; the others are plain text.
bool toggle_button(const char* label, bool on);

/// Puts the next item, `width` wide, at the right edge of the line before.
void align_right(float width);

/// A choice of resolution: pixels a side.
void draw_resolution_choice(const char* label, std::initializer_list<int> choices, int& resolution);

/// The largest square in the middle of a rectangle.
Rect centred_square(const Rect& rect);

/// A sentence in the middle of a rectangle where there is nothing else to see: what to do next.
void centred_hint(const Rect& rect, const std::string& text);

/// The width of a button with this text.
float button_width(const char* label);

}  // namespace patina
