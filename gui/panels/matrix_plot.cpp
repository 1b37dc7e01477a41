#include "gui/panels/matrix_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gui/gl/imgui_renderer.h"
#include "gui/panels/marginal_bars.h"
#include "gui/plot/density_picture.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr float kLeastCell = 3.2f;  // em
constexpr float kLabelRoom = 1.3f;  // em, above the first cell
constexpr float kCellGap = 2;       // pixels between cells
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr auto kCountingTime = std::chrono::milliseconds(4);  // of a frame
constexpr auto kPicturingTime = std::chrono::milliseconds(3);

std::string short_label(const ParameterTable& table, const PlotAxis& axis) {
  if (axis.kind == PlotAxis::Kind::log_posterior) return "Match";
  const std::string label = axis_label(table, axis);
  return label.substr(0, label.find(" ("));
}

}  // namespace

std::optional<MatrixPlot::Pair> MatrixPlot::draw(const PanelContext& context, const Rect& rect,
                                                 MarkingTool tool) {
  ExplorerModel& model = context.session.model();
  grids_.follow(model, context.session.run_version());
  ImGui::SetCursorScreenPos(rect.position);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::BeginChild("pairs", rect.size, false, ImGuiWindowFlags_HorizontalScrollbar);
  ImGui::PopStyleVar();
  place_cells(rect);
  bring_up_to_date(model);
  draw_cells(model, visible_part());
  draw_labels(model);
  const auto clicked = handle_mouse(model, tool);
  ImGui::EndChild();
  return clicked;
}

void MatrixPlot::place_cells(const Rect& rect) {
  const float em = ImGui::GetFontSize(), count = static_cast<float>(std::max<std::size_t>(grids_.size(), 1));
  corner_ = ImGui::GetCursorScreenPos();
  corner_.y += kLabelRoom * em;
  cell_ = {std::max(kLeastCell * em, std::floor(rect.size.x / count)),
           std::max(kLeastCell * em, std::floor((rect.size.y - kLabelRoom * em) / count))};
}

PlotView MatrixPlot::cell_view(std::size_t row, std::size_t column) const {
  PlotView view;
  view.left = corner_.x + cell_.x * static_cast<float>(column);
  view.top = corner_.y + cell_.y * static_cast<float>(row);
  view.width = cell_.x - kCellGap;
  view.height = cell_.y - kCellGap;
  view.x = grids_.range(column);
  view.y = grids_.range(row);
  return view;
}

PairGrids::Part MatrixPlot::visible_part() const {
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const auto index = [&](float pixels, float cell) {
    const float cells = std::clamp(pixels / cell, 0.0f, static_cast<float>(grids_.size()));
    return static_cast<std::size_t>(cells);
  };
  return {index(from.y - corner_.y, cell_.y),
          std::min(grids_.size(), index(from.y + size.y - corner_.y, cell_.y) + 1),
          index(from.x - corner_.x, cell_.x),
          std::min(grids_.size(), index(from.x + size.x - corner_.x, cell_.x) + 1)};
}

void MatrixPlot::bring_up_to_date(const ExplorerModel& model) {
  const auto start = PairGrids::Clock::now();
  if (grids_.edition() != edition_) {
    edition_ = grids_.edition();
    make_atlas();
  }
  const PairGrids::Part part = visible_part();
  const bool counted = grids_.advance(model, part, start + kCountingTime);
  const bool pictured = send_pictures(part, start + kCountingTime + kPicturingTime);
  busy_ = !counted || !pictured;
}

void MatrixPlot::make_atlas() {
  pictured_.assign(grids_.size() * grids_.size(), kNone);
  const int side = static_cast<int>(grids_.size()) * PairGrids::kBins;
  if (atlas_ && atlas_->width() == side) return;  // the old pictures are good until new ones come
  const std::vector<std::uint8_t> clear(4 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  atlas_ = Texture::rgba8(gl_, side, side, clear, TextureFilter::linear);
}

bool MatrixPlot::send_pictures(const PairGrids::Part& part, PairGrids::Clock::time_point deadline) {
  const DensityColours colours = grids_.colours().colouring().kind == Colouring::Kind::axis ||
                                         grids_.colours().colouring().kind == Colouring::Kind::chain
                                     ? DensityColours::mean
                                     : DensityColours::count;
  // Those that were last are first in the next frame: all get their turn while draws arrive.
  std::vector<Place> stale;
  for (std::size_t row = part.first_row; row < part.last_row; ++row) {
    for (std::size_t column = part.first_column; column < std::min(part.last_column, row); ++column) {
      if (pictured_[row * grids_.size() + column] != grids_.counted(row, column))
        stale.push_back({row, column});
    }
  }
  std::ranges::sort(stale, {}, [&](const Place& p) {
    const std::size_t pictured = pictured_[p.row * grids_.size() + p.column];
    return pictured == kNone ? 0 : pictured;
  });
  for (const Place& place : stale) {
    if (PairGrids::Clock::now() >= deadline) return false;
    const std::size_t counted = grids_.counted(place.row, place.column);
    pictured_[place.row * grids_.size() + place.column] = counted;
    if (counted == 0) continue;
    atlas_->update(static_cast<int>(place.column) * PairGrids::kBins,
                   static_cast<int>(place.row) * PairGrids::kBins, PairGrids::kBins, PairGrids::kBins,
                   density_picture(grids_.cells(place.row, place.column), colours));
  }
  return true;
}

void MatrixPlot::draw_cells(const ExplorerModel& model, const PairGrids::Part& part) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float count = static_cast<float>(grids_.size());
  for (std::size_t row = part.first_row; row < part.last_row; ++row) {
    const PlotView first = cell_view(row, 0), last = cell_view(row, row);
    list.AddRectFilled({first.left, first.top}, {last.left + last.width, last.top + last.height},
                       theme::kWell);
  }
  {
    const PremultipliedImages premultiplied(list);
    list.AddImage(atlas_->imgui_id(), corner_, {corner_.x + count * cell_.x, corner_.y + count * cell_.y});
  }
  for (std::size_t i = part.first_row; i < part.last_row; ++i) {
    const PlotView last = cell_view(i, i);
    const float right = last.left + last.width, bottom = last.top + last.height;
    list.AddRectFilled({corner_.x, bottom}, {right, bottom + kCellGap}, theme::kPanel);
    list.AddRectFilled({right, last.top}, {right + kCellGap, corner_.y + count * cell_.y}, theme::kPanel);
    draw_bars_above({last.left, bottom, last.width, 0, last.x, {}}, grids_.bars(i), 0.9f * last.height);
    for (std::size_t column = part.first_column; column < std::min(part.last_column, i); ++column)
      draw_points(model, {i, column});
  }
}

void MatrixPlot::draw_points(const ExplorerModel& model, const Place& place) const {
  const PlotView view = cell_view(place.row, place.column);
  const auto dot = [&](std::size_t draw, float radius, ImU32 color) {
    const ImVec2 at{view.pixel_of_x(model.draws().place(grids_.axis(place.column), draw)),
                    view.pixel_of_y(model.draws().place(grids_.axis(place.row), draw))};
    if (at.x < view.left || at.x > view.left + view.width || at.y < view.top || at.y > view.top + view.height)
      return;
    ImGui::GetWindowDrawList()->AddCircle(at, radius, color, 8, 0.1f * ImGui::GetFontSize());
  };
  if (const auto selected = model.selected()) dot(*selected, 0.25f * ImGui::GetFontSize(), theme::kText);
}

void MatrixPlot::draw_labels(const ExplorerModel& model) const {
  const float em = ImGui::GetFontSize(), right = corner_.x + cell_.x * static_cast<float>(grids_.size());
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const PlotView view = cell_view(i, i);
    ImGui::SetCursorScreenPos({view.left, view.top - kLabelRoom * em + 0.1f * em});
    elided_text(short_label(model.table(), grids_.axis(i)), right - view.left, theme::kMuted);
  }
}

std::optional<MatrixPlot::Place> MatrixPlot::place_at(ImVec2 pixel) const {
  const float column = std::floor((pixel.x - corner_.x) / cell_.x),
              row = std::floor((pixel.y - corner_.y) / cell_.y);
  if (column < 0 || row < column || row >= static_cast<float>(grids_.size())) return std::nullopt;
  return Place{static_cast<std::size_t>(row), static_cast<std::size_t>(column)};
}

std::optional<MatrixPlot::Pair> MatrixPlot::handle_mouse(ExplorerModel& model, MarkingTool tool) {
  const float count = static_cast<float>(grids_.size());
  ImGui::SetCursorScreenPos(corner_);
  mouse_area("cells", {count * cell_.x, count * cell_.y});
  const std::optional<Place> under = place_at(ImGui::GetIO().MousePos);
  if (ImGui::IsItemActivated()) pressed_ = under;
  std::optional<Pair> clicked;
  if (pressed_) {
    const PlotAxis x = grids_.axis(pressed_->column), y = grids_.axis(pressed_->row);
    const PlotView view = cell_view(pressed_->row, pressed_->column);
    const bool on_diagonal = pressed_->row == pressed_->column;
    if (on_diagonal) {
      const bool released = ImGui::IsItemDeactivated() && under == pressed_;
      if (released) clicked = Pair{x, {PlotAxis::Kind::log_posterior, 0}};
    } else if (marking_.handle(model, x, y, view, tool) && under == pressed_) {
      clicked = Pair{x, y};
    }
    marking_.draw(view);
  }
  if (under && ImGui::IsItemHovered() && !marking_.active()) draw_hover(model, *under);
  if (!ImGui::IsItemActive()) pressed_.reset();
  return clicked;
}

void MatrixPlot::draw_hover(const ExplorerModel& model, const Place& place) const {
  const PlotView view = cell_view(place.row, place.column);
  ImGui::GetWindowDrawList()->AddRect({view.left - 1, view.top - 1},
                                      {view.left + view.width + 1, view.top + view.height + 1},
                                      theme::kAccent);
  const auto line = [&](std::size_t index) {
    const PlotAxis& axis = grids_.axis(index);
    const PlotRange range = model.default_range(axis);
    std::string text = axis_label(model.table(), axis);
    if (axis.kind != PlotAxis::Kind::discrete)
      text += ": " + tick_label(model.table(), axis, range.low) + " to " +
              tick_label(model.table(), axis, range.high);
    return text;
  };
  std::string text = line(place.row);
  if (place.column != place.row) text += "\n" + line(place.column);
  ImGui::SetTooltip("%s\nClick to see it large, drag to mark draws", text.c_str());
}

}  // namespace patina
