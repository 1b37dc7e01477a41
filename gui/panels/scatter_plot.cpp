#include "gui/panels/scatter_plot.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/panels/draw_hover.h"
#include "gui/panels/marginal_bars.h"
#include "gui/panels/plot_frame.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr float kClickReach = 2.0f;  // em
constexpr float kHoverReach = 0.6f;  // em
constexpr float kBarRoom = 2.2f;     // em
constexpr float kBarWidth = 0.5f;    // em

// A density of so many draws is much the same with a few more.
constexpr std::chrono::milliseconds kDensityInterval(50);

constexpr ImU32 kUnmarked = IM_COL32(110, 114, 118, 255);

ImU32 with_alpha(ImU32 color, ImU32 alpha) {
  return (color & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

bool is_continuous(const PlotAxis& axis) {
  return axis.kind == PlotAxis::Kind::continuous || axis.kind == PlotAxis::Kind::log_posterior;
}

std::string empty_text(const Session& session) {
  const RunPhase phase = session.status().phase;
  if (is_over(phase) && session.status().read_fraction == 1) return "This run ended before its first draw";
  return phase == RunPhase::searching ? "Draws appear here once a good match is found"
                                      : "The first draws appear here in a moment";
}

/// How many independent draws there are for the worse known of two axes.
std::optional<double> independent_draws(const Session& session, const PlotAxis& x, const PlotAxis& y) {
  if (!session.summary()) return std::nullopt;
  const ParameterTable& table = session.model().table();
  const auto name = [&](const PlotAxis& axis) {
    return axis.kind == PlotAxis::Kind::continuous ? table.continuous[axis.index].name : "lp";
  };
  std::optional<double> least;
  for (const QuantitySummary& quantity : session.summary()->quantities) {
    const bool shown = quantity.name == name(x) || quantity.name == name(y);
    if (shown && quantity.bulk_ess > 0)
      least = std::min(least.value_or(quantity.bulk_ess), quantity.bulk_ess);
  }
  return least;
}

}  // namespace

ScatterPlot::ScatterPlot(const Gl& gl, Thumbnails& thumbnails) : thumbnails_(thumbnails), points_(gl) {}

void ScatterPlot::draw(const PanelContext& context, const Rect& rect, const PlotSubject& subject,
                       const std::function<void(const PlotView&)>& beneath) {
  ExplorerModel& model = context.session.model();
  place_plot(rect);
  follow_draws(context.session, subject);
  send_points(model);
  count_bars(context.session);
  draw_plot_ground(view_, model.table(), subject.x, subject.y);
  const ImVec2 corner{view_.left, view_.top}, end{view_.left + view_.width, view_.top + view_.height};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(corner, end, true);
  if (beneath) beneath(view_);
  points_.show(list, corner, end);
  if (model.shows_contours()) draw_contours(context.session);
  draw_marks(model);
  marking_.draw(view_);
  cursor_.draw(view_, subject.tool);
  list.PopClipRect();
  draw_tick_labels(view_, model.table(), subject.x, subject.y);
  const float bars = kBarRoom * ImGui::GetFontSize();
  if (subject.x.kind != PlotAxis::Kind::iteration) draw_bars_above(view_, x_bars_, bars);
  draw_bars_beside(view_, y_bars_, bars);
  if (model.draws().size() == 0)
    centred_hint({corner, {view_.width, view_.height}}, empty_text(context.session));
  handle_mouse(context.session, subject.tool);
  cursor_.handle(model, contents_.x, contents_.y, view_, subject.tool, kClickReach * ImGui::GetFontSize());
}

void ScatterPlot::place_plot(const Rect& rect) {
  const float em = ImGui::GetFontSize(), bars = kBarRoom * em;
  view_.left = std::floor(rect.position.x + kTickRoomLeft * em);
  view_.top = std::floor(rect.position.y + bars);
  view_.width = std::max(16.0f, std::floor(rect.size.x - kTickRoomLeft * em - bars));
  view_.height = std::max(16.0f, std::floor(rect.size.y - kTickRoomBelow * em - bars));
}

void ScatterPlot::follow_draws(const Session& session, const PlotSubject& subject) {
  const ExplorerModel& model = session.model();
  const PlotRange x = model.default_range(subject.x), y = model.default_range(subject.y);
  Contents contents{session.run_version(),
                    subject.x,
                    subject.y,
                    model.hides_warmup(),
                    model.draws().sampling_count() > 0,
                    model.marked(),
                    contents_.colours};
  contents.colours.follow(model, contents.run);
  if (contents != contents_) {
    const bool same_plane =
        contents.run == contents_.run && contents.x == contents_.x && contents.y == contents_.y;
    contents_ = contents;
    points_.clear();
    sent_ = counted_ = 0;
    x_bars_ = y_bars_ = {};
    if (!same_plane) {
      following_ = false;
      marking_.cancel();
      cursor_.end();
    }
  }
  // The first draws are not to be lost in the prior's range, which was shown until they came.
  const bool has_draws = model.draws().size() > 0, first = has_draws && !had_draws_;
  had_draws_ = has_draws;
  const std::optional<PlotPart> part = model.part(subject.x, subject.y);
  const bool goes_on_following = following_ && !first;
  following_ = !part;
  view_.x = part ? part->across : goes_on_following ? followed(view_.x, x) : padded(x);
  view_.y = part ? part->up : goes_on_following ? followed(view_.y, y) : padded(y);
}

void ScatterPlot::send_points(const ExplorerModel& model) {
  const DrawColumns& draws = model.draws();
  const Clock::time_point now = Clock::now();
  behind_ = sent_ > 0 && sent_ < draws.size() && shows_density() && now - sent_at_ < kDensityInterval;
  if (!behind_) {
    append_points(model);
    sent_at_ = now;
  }
  const float density = ImGui::GetIO().DisplayFramebufferScale.x;
  const Colouring::Kind kind = model.colouring().kind;
  PointStyle style;
  style.diameter = std::max(3.0f, 0.27f * ImGui::GetFontSize() * density);
  if (kind == Colouring::Kind::density) style.density_above = 0;
  const bool own_colours = kind == Colouring::Kind::chain || kind == Colouring::Kind::axis;
  style.density_colours = own_colours ? DensityColours::mean : DensityColours::count;
  points_.set_style(style);
  points_.set_view({view_.x.low, view_.x.high, view_.y.low, view_.y.high},
                   static_cast<int>(view_.width * density), static_cast<int>(view_.height * density));
  redrew_density_ = points_.render() && shows_density();
}

void ScatterPlot::append_points(const ExplorerModel& model) {
  const DrawColumns& draws = model.draws();
  // Dimmed ones first, so that they lie beneath the others where all are drawn anew.
  std::vector<PlotPoint> points, dimmed;
  for (; sent_ < draws.size(); ++sent_) {
    const double x = draws.place(contents_.x, sent_), y = draws.place(contents_.y, sent_);
    if (!std::isfinite(x) || !std::isfinite(y) || !model.visible(sent_)) continue;
    const bool unmarked = !contents_.marked.empty() && !contents_.marked.contains(sent_);
    const bool dim = unmarked || (contents_.dims_warmup && draws.warmup(sent_));
    const ImU32 color = unmarked ? kUnmarked : contents_.colours.of(model, sent_);
    (dim ? dimmed : points).push_back({x, y, with_alpha(color, 200), dim});
  }
  points_.append(dimmed);
  points_.append(points);
}

void ScatterPlot::count_bars(const Session& session) {
  const ExplorerModel& model = session.model();
  const float width = kBarWidth * ImGui::GetFontSize();
  const int columns = std::max(1, static_cast<int>(view_.width / width)),
            rows = std::max(1, static_cast<int>(view_.height / width));
  if (x_bars_.bins() != columns || y_bars_.bins() != rows || x_bars_.range() != view_.x ||
      y_bars_.range() != view_.y) {
    x_bars_ = Histogram(view_.x, columns);
    y_bars_ = Histogram(view_.y, rows);
    counted_ = 0;
  }
  const DrawColumns& draws = model.draws();
  // A live run asks for a frame soon enough to count what is left out here.
  const bool more = counted_ > 0 && counted_ < draws.size();
  if (more && session.is_live() && !bar_pace_.due()) return;
  for (; counted_ < draws.size(); ++counted_) {
    if (!model.in_answer(counted_)) continue;
    const bool marked = contents_.marked.contains(counted_);
    x_bars_.add(draws.place(contents_.x, counted_), marked);
    y_bars_.add(draws.place(contents_.y, counted_), marked);
  }
}

void ScatterPlot::draw_contours(const Session& session) {
  if (!is_continuous(contents_.x) || !is_continuous(contents_.y)) return;
  const std::array<ImU32, 2> colors{with_alpha(theme::kText, 245), with_alpha(theme::kText, 150)};
  const auto& edges = regions_.follow(session.model(), contents_.run, contents_.x, contents_.y,
                                      independent_draws(session, contents_.x, contents_.y));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    ImVec2 highest{0, view_.top + view_.height};
    for (const ContourPiece& piece : edges[i]) {
      const ImVec2 from{view_.pixel_of_x(piece.x0), view_.pixel_of_y(piece.y0)};
      list.AddLine(from, {view_.pixel_of_x(piece.x1), view_.pixel_of_y(piece.y1)}, colors[i], 0.1f * em);
      if (from.y < highest.y) highest = from;
    }
    if (edges[i].empty()) continue;
    const std::string text = number_text(100 * CredibleRegions::kShares[i], 2) + " %";
    list.AddText({highest.x - 0.5f * ImGui::CalcTextSize(text.c_str()).x, highest.y - 1.15f * em}, colors[i],
                 text.c_str());
  }
}

void ScatterPlot::draw_marks(const ExplorerModel& model) const {
  const float em = ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto ring = [&](std::size_t draw, float radius, ImU32 color) {
    const ImVec2 at{view_.pixel_of_x(model.draws().place(contents_.x, draw)),
                    view_.pixel_of_y(model.draws().place(contents_.y, draw))};
    list.AddCircle(at, radius, IM_COL32(0, 0, 0, 160), 0, 0.3f * em);
    list.AddCircle(at, radius, color, 0, 0.14f * em);
  };
  for (const Star& star : model.stars()) {
    const auto draw = model.draw_of(star);
    if (!draw || !model.visible(*draw)) continue;
    const PlotPlace at{model.draws().place(contents_.x, *draw), model.draws().place(contents_.y, *draw)};
    add_star(list, {view_.pixel_of_x(at.x), view_.pixel_of_y(at.y)}, 0.45f * em, theme::kWarning);
  }
  if (const auto best = model.best(); best && best != model.selected())
    ring(*best, 0.42f * em, theme::kAccent);
  if (const auto selected = model.selected()) ring(*selected, 0.5f * em, theme::kText);
}

PlotPlace ScatterPlot::mouse_place() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {view_.x_of_pixel(mouse.x), view_.y_of_pixel(mouse.y)};
}

std::optional<std::size_t> ScatterPlot::hit(const ExplorerModel& model, float reach) const {
  return model.nearest(contents_.x, contents_.y, mouse_place(), {view_.x_per_pixel(), view_.y_per_pixel()},
                       reach * ImGui::GetFontSize());
}

void ScatterPlot::handle_mouse(Session& session, MarkingTool tool) {
  ExplorerModel& model = session.model();
  ImGui::SetCursorScreenPos({view_.left, view_.top});
  mouse_area("plot", {view_.width, view_.height},
             ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  const ImGuiIO& io = ImGui::GetIO();
  // The second click of two is an order to show all.
  if (marking_.handle(model, contents_.x, contents_.y, view_, tool) &&
      io.MouseClickedLastCount[ImGuiMouseButton_Left] < 2) {
    if (const auto draw = hit(model, kClickReach)) model.select(draw);
  }
  if (ImGui::IsItemActivated() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) held_ = hit(model, kClickReach);
  if (!ImGui::IsItemActive() || marking_.active()) held_.reset();
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0)) {
    model.show_part({contents_.x, contents_.y, moved(view_.x, -io.MouseDelta.x * view_.x_per_pixel()),
                     moved(view_.y, io.MouseDelta.y * view_.y_per_pixel())});
  }
  if (!ImGui::IsItemHovered()) return;
  if (io.MouseWheel != 0) {
    const PlotPlace about = mouse_place();
    const double factor = std::pow(0.85, io.MouseWheel);
    model.show_part(
        {contents_.x, contents_.y, zoomed(view_.x, about.x, factor), zoomed(view_.y, about.y, factor)});
  }
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) model.show_all(contents_.x, contents_.y);
  if (marking_.active() || mouse_rests_after_click()) return;
  if (const auto draw = hit(model, kHoverReach))
    draw_hover(session, thumbnails_, *draw, contents_.x, contents_.y);
}

}  // namespace patina
