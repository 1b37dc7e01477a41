#include "gui/panels/trace_plot.h"

#include <algorithm>
#include <optional>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr ImU32 kCourseOpacity = 0x60000000u;
constexpr ImU32 kShade = IM_COL32(255, 255, 255, 14);

void draw_course(const ChainTrace& trace, const PlotView& view, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto steps = static_cast<double>(trace.steps_per_bucket());
  const float thickness = std::max(1.0f, 0.06f * ImGui::GetFontSize());
  std::optional<ImVec2> from;
  for (std::size_t i = 0; i < trace.buckets().size(); ++i) {
    const ChainTrace::Bucket& bucket = trace.buckets()[i];
    if (bucket.empty) continue;
    const float x = view.pixel_of_x((static_cast<double>(i) + 0.5) * steps - 0.5);
    if (from) list.AddLine(*from, {x, view.pixel_of_y(bucket.first)}, color, thickness);
    if (bucket.high > bucket.low)
      list.AddLine({x, view.pixel_of_y(bucket.low)}, {x, view.pixel_of_y(bucket.high)}, color, thickness);
    from = ImVec2{x, view.pixel_of_y(bucket.last)};
  }
}

}  // namespace

void TracePlot::draw(const PanelContext& context, const Rect& rect, MarkingTool tool) {
  const ExplorerModel& model = context.session.model();
  follow(model, context.session.run_version());
  const PlotSubject subject{{PlotAxis::Kind::iteration, 0}, model.y_axis(), tool};
  plot_.draw(context, rect, subject, [&](const PlotView& view) { draw_courses(model, view); });
}

void TracePlot::follow(const ExplorerModel& model, int run) {
  if (run != run_ || model.y_axis() != axis_ || model.hides_warmup() != hides_warmup_) {
    run_ = run, axis_ = model.y_axis(), hides_warmup_ = model.hides_warmup();
    chains_.clear();
    added_ = 0;
  }
  const DrawColumns& draws = model.draws();
  chains_.resize(static_cast<std::size_t>(draws.chain_count()));
  for (; added_ < draws.size(); ++added_) {
    if (!model.visible(added_)) continue;
    chains_[static_cast<std::size_t>(draws.chain(added_))].add(draws.iteration(added_),
                                                               draws.place(axis_, added_));
  }
}

void TracePlot::draw_courses(const ExplorerModel& model, const PlotView& view) const {
  if (const auto steps = model.draws().warmup_steps(); steps > 0 && !model.hides_warmup()) {
    const float from = view.pixel_of_x(-0.5), to = view.pixel_of_x(static_cast<double>(steps) - 0.5);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({from, view.top}, {to, view.top + view.height}, kShade);
    const char* text = "Warm-up";
    const float em = ImGui::GetFontSize();
    const bool fits = ImGui::CalcTextSize(text).x + 0.6f * em < to - std::max(from, view.left);
    if (fits)
      list.AddText({std::max(from, view.left) + 0.3f * em, view.top + 0.3f * em}, theme::kMuted, text);
  }
  for (std::size_t chain = 0; chain < chains_.size(); ++chain) {
    const ImU32 color = theme::chain_color(static_cast<int>(chain));
    draw_course(chains_[chain], view, (color & ~IM_COL32_A_MASK) | kCourseOpacity);
  }
}

}  // namespace patina
