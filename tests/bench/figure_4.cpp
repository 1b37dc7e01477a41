// The paper's Figure 4: three images of translucent media, and draws from the posterior of each one's
// scattering coefficient and anisotropy, which follow (1 - g) sigma_s = const.
//   figure-4 OUT.png
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/io/image_file.h"
#include "gui/gl/objects.h"
#include "gui/plot/plot_view.h"
#include "gui/window/fonts.h"
#include "gui/window/offscreen_window.h"
#include "tests/support/similar_media.h"

namespace patina {
namespace {

constexpr float kFont = 17, kMargin = 24, kPlot = 380, kPicture = 190, kGap = 72;
constexpr float kWidth = 3 * kPlot + 2 * kGap + 3 * kMargin + 32, kHeight = kPicture + kPlot + 7 * kMargin;
constexpr ImU32 kInk = IM_COL32(30, 32, 34, 255), kFaint = IM_COL32(226, 228, 230, 255),
                kDot = IM_COL32(20, 110, 180, 70), kCurve = IM_COL32(214, 90, 20, 255);

struct Panel {
  Scatterer truth;
  Image picture;
  std::vector<Scatterer> draws;
};

Panel make_panel(const Scatterer& truth) {
  const Posterior posterior = posterior_of(truth, 64);
  Panel panel{truth, picture_of(truth, 256), {}};
  panel.draws = draw_scatterers(posterior, {.chains = 4, .warmup = 500, .draws = 500, .threads = 2});
  std::printf("(1 - g) sigma_s = %.2f: %zu draws\n", truth.reduced(), panel.draws.size());
  return panel;
}

void centred_text(ImDrawList& list, ImVec2 middle, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddText({middle.x - size.x / 2, middle.y - size.y / 2}, kInk, text.c_str());
}

void draw_axes(ImDrawList& list, const PlotView& view) {
  const float right = view.left + view.width, bottom = view.top + view.height;
  const auto label = [](double tick) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%g", tick);
    return std::string(text.data());
  };
  for (const double tick : round_ticks(view.x, 6)) {
    const float x = view.pixel_of_x(tick);
    list.AddLine({x, view.top}, {x, bottom}, kFaint);
    centred_text(list, {x, bottom + 0.7f * kMargin}, label(tick));
  }
  for (const double tick : round_ticks(view.y, 6)) {
    const float y = view.pixel_of_y(tick);
    list.AddLine({view.left, y}, {right, y}, kFaint);
    centred_text(list, {view.left - kMargin, y}, label(tick));
  }
  list.AddRect({view.left, view.top}, {right, bottom}, kInk);
  centred_text(list, {(view.left + right) / 2, bottom + 1.7f * kMargin}, "\u03c3s (1/cm)");
  list.AddText({view.left - 2 * kMargin, view.top - 1.1f * kMargin}, kInk, "g");
}

void draw_curve(ImDrawList& list, const PlotView& view, double reduced) {
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double g = view.y.low + view.y.span() * i / kSteps;
    list.PathLineTo({view.pixel_of_x(reduced / (1 - g)), view.pixel_of_y(g)});
  }
  list.PathStroke(kCurve, ImDrawFlags_None, 2);
}

void draw_panel(ImDrawList& list, const Panel& panel, const Texture& picture, float left) {
  const float middle = left + kPlot / 2;
  list.AddImage(picture.imgui_id(), {middle - kPicture / 2, kMargin},
                {middle + kPicture / 2, kMargin + kPicture});
  const PlotView view{left, kPicture + 4 * kMargin, kPlot, kPlot, {0, 10}, {-1, 1}};
  draw_axes(list, view);
  list.PushClipRect({view.left, view.top}, {view.left + view.width, view.top + view.height});
  for (const Scatterer& draw : panel.draws)
    list.AddCircleFilled({view.pixel_of_x(draw.sigma_s), view.pixel_of_y(draw.g)}, 2.5f, kDot);
  draw_curve(list, view, panel.truth.reduced());
  const ImVec2 truth{view.pixel_of_x(panel.truth.sigma_s), view.pixel_of_y(panel.truth.g)};
  list.AddCircleFilled(truth, 5, IM_COL32_WHITE);
  list.AddCircle(truth, 5, kInk, 0, 2);
  list.PopClipRect();
  std::array<char, 64> title{};
  std::snprintf(title.data(), title.size(), "(1 \u2013 g) \u03c3s = %g per cm", panel.truth.reduced());
  centred_text(list, {middle, kPicture + 2 * kMargin}, title.data());
}

Image draw_figure(const std::vector<Panel>& panels) {
  const auto window = OffscreenWindow::make(static_cast<int>(kWidth), static_cast<int>(kHeight));
  load_fonts(kFont, window->pixel_density());
  std::vector<Texture> pictures;
  for (const Panel& panel : panels) pictures.push_back(Texture::picture(window->gl(), panel.picture));
  window->begin_frame(0);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0, 0}, {kWidth, kHeight}, IM_COL32_WHITE);
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(list, panels[i], pictures[i], 3 * kMargin + static_cast<float>(i) * (kPlot + kGap));
  window->end_frame();
  return window->screenshot();
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: figure-4 OUT.png\n", stderr);
    return 2;
  }
  try {
    std::vector<patina::Panel> panels;
    for (const patina::Scatterer& truth : patina::kScatterers) panels.push_back(patina::make_panel(truth));
    patina::write_image(argv[1], patina::draw_figure(panels));
  } catch (const patina::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
