#include "gui/panels/gallery.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gui/panels/plot_frame.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr float kCard = 9.6f;      // em, a picture's side
constexpr float kComparison = 20;  // em, at most
constexpr int kCompared = 512;     // pixels a side

void draw_picture_or_well(const Texture* picture, const Rect& rect) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{rect.position.x + rect.size.x, rect.position.y + rect.size.y};
  if (picture != nullptr) {
    list.AddImage(picture->imgui_id(), rect.position, end);
  } else {
    list.AddRectFilled(rect.position, end, theme::kWell);
  }
}

}  // namespace

void Gallery::draw(const PanelContext& context, const Rect& rect, const GalleryActions& actions) {
  Session& session = context.session;
  const ExplorerModel& model = session.model();
  if (run_ != session.run_version()) {
    run_ = session.run_version();
    a_.reset();
    b_.reset();
    annotated_.reset();
  }
  modes_.follow(model, run_);
  shown_.clear();
  ImGui::SetCursorScreenPos(rect.position);
  ImGui::BeginChild("gallery", rect.size);
  draw_head(context, actions);
  if (a_ && b_) draw_comparison(session);
  if (a_.has_value() != b_.has_value()) {
    muted_text(a_ ? "Press B under another draw to compare it with A."
                  : "Press A under another draw to compare it with B.");
  }
  heading_text(context, "Starred");
  const auto stars = starred(model);
  if (stars.empty()) {
    muted_text(
        "Press S to star the draw that is shown: it stays here with a note of yours, and is kept with the "
        "run.");
  }
  draw_cards(context, stars, actions);
  ImGui::Spacing();
  heading_text(context, "Kinds of solution");
  tooltip("Draws that agree in every choice and lie in one cloud; of each kind the draw that matches best.");
  const auto kinds = modes(model);
  if (kinds.empty())
    muted_text("Looked for once there are " + std::to_string(ModeFinder::kLeastDraws) + " draws.");
  draw_cards(context, kinds, actions);
  ImGui::EndChild();
}

std::optional<Rect> Gallery::picture_of(std::size_t draw) const {
  const auto found = std::ranges::find(shown_, draw, &Shown::draw);
  if (found == shown_.end()) return std::nullopt;
  return found->picture;
}

std::vector<Gallery::Card> Gallery::starred(const ExplorerModel& model) const {
  std::vector<Card> cards;
  for (std::size_t i = 0; i < model.stars().size(); ++i) {
    const auto draw = model.draw_of(model.stars()[i]);
    if (draw) cards.push_back({*draw, i, "Match " + number_text(model.draws().lp(*draw), 4)});
  }
  if (order_ == Order::newest) std::ranges::reverse(cards);
  const auto lp = [&](const Card& card) { return model.draws().lp(card.draw); };
  if (order_ == Order::best) std::ranges::stable_sort(cards, std::greater<>(), lp);
  return cards;
}

std::vector<Gallery::Card> Gallery::modes(const ExplorerModel& model) const {
  std::vector<Card> cards;
  for (const FoundMode& mode : modes_.modes()) {
    const double percent = std::round(100 * mode.share);
    cards.push_back({mode.best, std::nullopt,
                     number_text(percent, 3) + " % of the draws\nBest match " +
                         number_text(model.draws().lp(mode.best), 4)});
  }
  return cards;
}

void Gallery::draw_head(const PanelContext& context, const GalleryActions& actions) {
  static constexpr std::array<const char*, 3> kOrders{"Best match first", "Newest star first",
                                                      "Oldest star first"};
  ImGui::SetNextItemWidth(11 * ImGui::GetFontSize());
  int order = static_cast<int>(order_);
  if (ImGui::Combo("##order", &order, kOrders.data(), static_cast<int>(kOrders.size())))
    order_ = static_cast<Order>(order);
  tooltip("In which order the starred draws come");
  align_right(button_width("Export all starred..."));
  ImGui::BeginDisabled(context.session.model().stars().empty());
  if (ImGui::Button("Export all starred...")) context.commands.push_back(actions.export_starred);
  ImGui::EndDisabled();
  tooltip("Write the parameters, render and maps of every starred draw, each to a folder of its own");
}

void Gallery::draw_comparison(Session& session) {
  const float em = ImGui::GetFontSize(), side = std::min(kComparison * em, ImGui::GetContentRegionAvail().x);
  const Rect square{ImGui::GetCursorScreenPos(), {side, side}};
  mouse_area("comparison", square.size);
  const float mouse = ImGui::IsItemHovered() ? ImGui::GetIO().MousePos.x : square.position.x + 0.5f * side;
  const float split = std::clamp(mouse, square.position.x, square.position.x + side);
  draw_picture_or_well(thumbnails_.find(session, *a_, kCompared, true), square);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{square.position.x + side, square.position.y + side};
  list.PushClipRect({split, square.position.y}, end, true);
  draw_picture_or_well(thumbnails_.find(session, *b_, kCompared, true), square);
  list.PopClipRect();
  list.AddRectFilled({split - 1, square.position.y}, {split + 1, end.y}, theme::kText);
  list.AddText({square.position.x + 0.5f * em, square.position.y + 0.4f * em}, theme::kText, "A");
  list.AddText({end.x - 1.2f * em, square.position.y + 0.4f * em}, theme::kText, "B");
  ImGui::SameLine();
  ImGui::BeginGroup();
  muted_text("Move the mouse over the picture to wipe from A to B.");
  const bool swapped = ImGui::Button("Swap");
  const bool closed = ImGui::Button("Close");
  ImGui::EndGroup();
  if (swapped) std::swap(a_, b_);
  if (closed) a_.reset(), b_.reset();
}

void Gallery::draw_cards(const PanelContext& context, const std::vector<Card>& cards,
                         const GalleryActions& actions) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, width = kCard * ImGui::GetFontSize() + gap;
  const int columns = std::max(1, static_cast<int>((ImGui::GetContentRegionAvail().x + gap) / width));
  for (std::size_t i = 0; i < cards.size(); ++i) {
    if (static_cast<int>(i) % columns != 0) ImGui::SameLine();
    draw_card(context, cards[i], actions);
  }
}

void Gallery::draw_card(const PanelContext& context, const Card& card, const GalleryActions& actions) {
  ImGui::PushID(card.star ? "star" : "mode");
  ImGui::PushID(static_cast<int>(card.draw));
  ImGui::BeginGroup();
  draw_picture(context.session, card);
  ImGui::TextDisabled("%s", card.caption.c_str());
  if (card.star) draw_note(context.session.model(), *card.star);
  draw_buttons(context, card, actions);
  ImGui::EndGroup();
  ImGui::PopID();
  ImGui::PopID();
}

void Gallery::draw_picture(Session& session, const Card& card) {
  ExplorerModel& model = session.model();
  const float em = ImGui::GetFontSize();
  const Rect square{ImGui::GetCursorScreenPos(), {kCard * em, kCard * em}};
  shown_.push_back({card.draw, square});
  if (picture_button("picture", square.size)) model.select(card.draw);
  tooltip("Select this draw: its render appears large");
  if (!ImGui::IsItemVisible()) return;
  draw_picture_or_well(thumbnails_.find(session, card.draw), square);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end{square.position.x + square.size.x, square.position.y + square.size.y};
  if (model.selected() == card.draw) list.AddRect(square.position, end, theme::kAccent, 0, 0, 0.2f * em);
  if (model.starred(card.draw))
    add_star(list, {end.x - 0.9f * em, square.position.y + 0.9f * em}, 0.6f * em, theme::kWarning);
}

void Gallery::draw_note(ExplorerModel& model, std::size_t star) {
  std::string note = annotated_ == star ? typed_ : model.stars()[star].note;
  ImGui::SetNextItemWidth(kCard * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##note", "Note", &note);
  if (ImGui::IsItemActive()) {
    annotated_ = star;
    typed_ = note;
  }
  if (!ImGui::IsItemDeactivated() || annotated_ != star) return;
  if (ImGui::IsItemDeactivatedAfterEdit()) model.annotate(star, typed_);
  annotated_.reset();
}

void Gallery::draw_buttons(const PanelContext& context, const Card& card, const GalleryActions& actions) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.3f * ImGui::GetFontSize(), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                      {0.2f * ImGui::GetFontSize(), ImGui::GetStyle().ItemSpacing.y});
  const auto side = [&](const char* label, std::optional<std::size_t>& chosen, const char* hint) {
    if (toggle_button(label, chosen == card.draw))
      chosen = chosen == card.draw ? std::nullopt : std::optional(card.draw);
    tooltip(hint);
    ImGui::SameLine();
  };
  side("A", a_, "Compare this draw, as A, with another, B");
  side("B", b_, "Compare this draw, as B, with another, A");
  if (ImGui::Button("Export"))
    context.commands.push_back([export_draw = actions.export_draw, draw = card.draw] { export_draw(draw); });
  tooltip("Write this draw's parameters, render and maps to a folder");
  ImGui::SameLine();
  ExplorerModel& model = context.session.model();
  const bool on = model.starred(card.draw);
  if (ImGui::Button(on ? "Unstar" : "Star")) {
    context.commands.push_back([&model, draw = card.draw] { model.toggle_star(draw); });
  }
  tooltip(on ? "Take the star and its note away (Ctrl+Z brings them back)"
             : "Keep this draw, with a note of yours");
  ImGui::PopStyleVar(2);
}

}  // namespace patina
