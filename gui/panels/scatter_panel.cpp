#include "gui/panels/scatter_panel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gui/gl/imgui_renderer.h"
#include "gui/panels/plot_frame.h"
#include "gui/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr float kClickReach = 2.0f;  // em
constexpr float kHoverReach = 0.6f;  // em
constexpr int kLegendChains = 8;     // more do not fit, and colours repeat

ImU32 with_alpha(ImU32 color, ImU32 alpha) {
  return (color & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

/// A choice among a table's axes. @return whether it changed
bool choose_axis(const char* id, const ParameterTable& table, PlotAxis& axis) {
  bool changed = false;
  ImGui::SetNextItemWidth(13 * ImGui::GetFontSize());
  if (!ImGui::BeginCombo(id, axis_label(table, axis).c_str(), ImGuiComboFlags_HeightLarge)) return false;
  for (const PlotAxis& choice : plot_axes(table)) {
    if (ImGui::Selectable(axis_label(table, choice).c_str(), choice == axis)) {
      axis = choice;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

void draw_legend(int chains) {
  const float em = ImGui::GetFontSize();
  const int shown = std::min(chains, kLegendChains);
  if (shown == 0) return;
  const float each = 1.35f * em + ImGui::CalcTextSize("0").x;
  align_right(ImGui::CalcTextSize("Chain").x + each * static_cast<float>(shown));
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Chain");
  for (int chain = 0; chain < shown; ++chain) {
    ImGui::SameLine(0, 0.6f * em);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float middle = at.y + ImGui::GetStyle().FramePadding.y + 0.55f * ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 0.3f * em, middle}, 0.26f * em,
                                                theme::chain_color(chain));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.75f * em);
    ImGui::TextDisabled("%d", chain + 1);
  }
}

}  // namespace

ScatterPanel::ScatterPanel(const Gl& gl) : points_(gl) {}

void ScatterPanel::draw(const PanelContext& context, const Rect& rect) {
  const PanelScope panel("Draws", rect, context,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  Session& session = context.session;
  if (!session.has_run()) {
    return centred_hint(
        rect, session.has_photo()
                  ? "Every point here will be a material that could have made the photo. Press Start."
                  : "Open a photo to find out which materials could have made it.");
  }
  ExplorerModel& model = session.model();
  draw_choices(context);
  place_plot();
  follow_draws(session);
  send_points(model);
  draw_plot_ground(view_, model.table(), model.x_axis(), model.y_axis());
  const ImVec2 corner{view_.left, view_.top}, end{view_.left + view_.width, view_.top + view_.height};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(corner, end, true);
  add_premultiplied_image(list, points_.texture().imgui_id(), corner, end);
  draw_marks(model);
  list.PopClipRect();
  draw_tick_labels(view_, model.table(), model.x_axis(), model.y_axis());
  if (model.draws().size() == 0)
    centred_hint({corner, {view_.width, view_.height}}, "The first draws appear here in a moment");
  handle_mouse(model);
}

void ScatterPanel::draw_choices(const PanelContext& context) {
  ExplorerModel& model = context.session.model();
  bool shown = !model.warmup_hidden();
  align_right(ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
              ImGui::CalcTextSize("Warm-up").x);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
  if (ImGui::Checkbox("Warm-up", &shown)) model.hide_warmup(!shown);
  ImGui::PopStyleVar();
  tooltip("Show the chains' first steps too, dimmed. They are not part of the answer.");

  PlotAxis x = model.x_axis(), y = model.y_axis();
  const float bottom = ImGui::GetContentRegionMax().y - ImGui::GetFrameHeight();
  if (choose_axis("##up", model.table(), y)) model.set_axes(x, y);
  tooltip("What the plot shows upwards");
  if (points_.shows_density()) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("brighter: more draws");
  } else {
    draw_legend(model.draws().chain_count());
  }
  const ImVec2 plot = ImGui::GetCursorPos();
  ImGui::SetCursorPos({ImGui::GetContentRegionMax().x - 13 * ImGui::GetFontSize(), bottom});
  if (choose_axis("##across", model.table(), x)) model.set_axes(x, y);
  tooltip("What the plot shows across");
  ImGui::SetCursorPos(plot);
}

void ScatterPanel::place_plot() {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  view_.left = std::floor(corner.x + kTickRoomLeft * em);
  view_.top = std::floor(corner.y);
  view_.width = std::max(16.0f, std::floor(room.x - kTickRoomLeft * em));
  view_.height =
      std::max(16.0f, std::floor(room.y - kTickRoomBelow * em - ImGui::GetFrameHeightWithSpacing()));
}

void ScatterPanel::follow_draws(const Session& session) {
  const ExplorerModel& model = session.model();
  const PlotRange x = model.default_range(model.x_axis()), y = model.default_range(model.y_axis());
  const Contents contents{session.run_version(), model.x_axis(), model.y_axis(), model.hides_warmup(),
                          model.draws().sampling_count() > 0};
  if (contents != contents_) {
    const bool same_plane =
        contents.run == contents_.run && contents.x == contents_.x && contents.y == contents_.y;
    contents_ = contents;
    points_.clear();
    sent_ = 0;
    if (!same_plane) {
      following_ = true;
      view_.x = padded(x);
      view_.y = padded(y);
    }
  }
  if (following_) {
    view_.x = followed(view_.x, x);
    view_.y = followed(view_.y, y);
  }
}

void ScatterPanel::send_points(const ExplorerModel& model) {
  const DrawColumns& draws = model.draws();
  std::vector<PlotPoint> points;
  points.reserve(draws.size() - sent_);
  for (; sent_ < draws.size(); ++sent_) {
    const double x = draws.place(model.x_axis(), sent_), y = draws.place(model.y_axis(), sent_);
    if (!std::isfinite(x) || !std::isfinite(y) || !model.visible(sent_)) continue;
    const bool dimmed = contents_.dims_warmup && draws.warmup(sent_);
    points.push_back({x, y, with_alpha(theme::chain_color(draws.chain(sent_)), 200), dimmed});
  }
  points_.append(points);
  const float density = ImGui::GetIO().DisplayFramebufferScale.x;
  PointStyle style;
  style.diameter = std::max(3.0f, 0.27f * ImGui::GetFontSize() * density);
  points_.set_style(style);
  points_.set_view({view_.x.low, view_.x.high, view_.y.low, view_.y.high},
                   static_cast<int>(view_.width * density), static_cast<int>(view_.height * density));
  points_.render();
}

void ScatterPanel::draw_marks(const ExplorerModel& model) const {
  const float em = ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto ring = [&](std::size_t draw, float radius, ImU32 color) {
    const ImVec2 at{view_.pixel_of_x(model.draws().place(model.x_axis(), draw)),
                    view_.pixel_of_y(model.draws().place(model.y_axis(), draw))};
    list.AddCircle(at, radius, IM_COL32(0, 0, 0, 160), 0, 0.3f * em);
    list.AddCircle(at, radius, color, 0, 0.14f * em);
  };
  if (const auto best = model.best(); best && best != model.selected())
    ring(*best, 0.42f * em, theme::kAccent);
  if (const auto selected = model.selected()) ring(*selected, 0.5f * em, theme::kText);
}

void ScatterPanel::handle_mouse(ExplorerModel& model) {
  ImGui::SetCursorScreenPos({view_.left, view_.top});
  ImGui::InvisibleButton("plot", {view_.width, view_.height},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0)) {
    view_.x = moved(view_.x, -io.MouseDelta.x * view_.x_per_pixel());
    view_.y = moved(view_.y, io.MouseDelta.y * view_.y_per_pixel());
    following_ = false;
  }
  if (!ImGui::IsItemHovered()) return;
  const double x = view_.x_of_pixel(io.MousePos.x), y = view_.y_of_pixel(io.MousePos.y);
  if (io.MouseWheel != 0) {
    const double factor = std::pow(0.85, io.MouseWheel);
    view_.x = zoomed(view_.x, x, factor);
    view_.y = zoomed(view_.y, y, factor);
    following_ = false;
  }
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
    view_.x = padded(model.default_range(model.x_axis()));
    view_.y = padded(model.default_range(model.y_axis()));
    following_ = true;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    const auto hit =
        model.nearest(x, y, view_.x_per_pixel(), view_.y_per_pixel(), kClickReach * ImGui::GetFontSize());
    if (hit) model.select(hit);
  }
  draw_hover(model);
}

void ScatterPanel::draw_hover(const ExplorerModel& model) const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto hit = model.nearest(view_.x_of_pixel(mouse.x), view_.y_of_pixel(mouse.y), view_.x_per_pixel(),
                                 view_.y_per_pixel(), kHoverReach * ImGui::GetFontSize());
  if (!hit) return;
  const auto& draws = model.draws();
  const auto line = [&](const PlotAxis& axis) {
    const double place = draws.place(axis, *hit);
    const bool discrete = axis.kind == PlotAxis::Kind::discrete;
    return axis_label(model.table(), axis) + ": " +
           tick_label(model.table(), axis, discrete ? std::round(place) : place);
  };
  std::string text = line(model.x_axis());
  if (model.y_axis() != model.x_axis()) text += "\n" + line(model.y_axis());
  const PlotAxis match{PlotAxis::Kind::log_posterior, 0};
  if (model.x_axis() != match && model.y_axis() != match) text += "\n" + line(match);
  text += "\nChain " + std::to_string(draws.chain(*hit) + 1) + ", step " +
          count_text(draws.iteration(*hit) + 1) + (draws.warmup(*hit) ? " (warm-up)" : "");
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace patina
