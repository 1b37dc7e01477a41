#include "gui/window/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patina::theme {
namespace {

/// As Dear ImGui's own style, the program has one at a time; the window's thread alone looks at it.
Theme applied = Theme::dark;

constexpr Role kPopup{IM_COL32(42, 44, 46, 255), IM_COL32(244, 245, 245, 255)};
constexpr Role kFrame{IM_COL32(48, 50, 53, 255), IM_COL32(212, 214, 216, 255)};
constexpr Role kFrameHovered{IM_COL32(60, 63, 66, 255), IM_COL32(200, 203, 205, 255)};
constexpr Role kFrameActive{IM_COL32(72, 75, 79, 255), IM_COL32(188, 191, 194, 255)};
constexpr Role kScrollbarHeld{IM_COL32(80, 83, 87, 255), IM_COL32(150, 154, 158, 255)};

ImVec4 color(ImU32 packed, float alpha = 1) {
  ImVec4 value = ImGui::ColorConvertU32ToFloat4(packed);
  value.w *= alpha;
  return value;
}

void apply_spacing(ImGuiStyle& style, float em) {
  style.WindowPadding = {0.9f * em, 0.8f * em};
  style.FramePadding = {0.6f * em, 0.35f * em};
  style.ItemSpacing = {0.6f * em, 0.5f * em};
  style.ItemInnerSpacing = {0.45f * em, 0.35f * em};
  style.CellPadding = {0.3f * em, 0.2f * em};
  style.ScrollbarSize = 0.7f * em;
  style.GrabMinSize = 0.8f * em;
  style.WindowRounding = style.PopupRounding = 0.4f * em;
  style.FrameRounding = style.GrabRounding = style.ScrollbarRounding = 0.3f * em;
  style.WindowBorderSize = 0;
  style.AntiAliasedLinesUseTex = false;  // the atlas is not interpolated: text lies on pixels
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.4f;
}

void apply_colors(ImGuiStyle& style) {
  ImVec4* colors = style.Colors;
  const auto set = [&](ImU32 packed, std::initializer_list<ImGuiCol> where, float alpha = 1) {
    for (const ImGuiCol index : where) colors[index] = color(packed, alpha);
  };
  set(kText, {ImGuiCol_Text});
  set(kMuted, {ImGuiCol_TextDisabled});
  set(kPanel, {ImGuiCol_WindowBg, ImGuiCol_TableHeaderBg});
  set(kPopup, {ImGuiCol_PopupBg});
  set(kLine, {ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderLight, ImGuiCol_TableBorderStrong});
  set(kFrame, {ImGuiCol_FrameBg, ImGuiCol_Button});
  set(kFrameHovered, {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered});
  set(kFrameActive, {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive});
  set(kAccent, {ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogram,
                ImGuiCol_NavHighlight});
  set(kAccent, {ImGuiCol_Header, ImGuiCol_TextSelectedBg}, 0.25f);
  set(kAccent, {ImGuiCol_HeaderHovered}, 0.35f);
  set(kAccent, {ImGuiCol_HeaderActive}, 0.45f);
  set(kPanel, {ImGuiCol_ScrollbarBg}, 0);
  set(kLine, {ImGuiCol_ScrollbarGrab});
  set(kScrollbarHeld, {ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive});
  set(IM_COL32(0, 0, 0, 255), {ImGuiCol_ModalWindowDimBg}, 0.55f);
  set(IM_COL32(255, 255, 255, 255), {ImGuiCol_TableRowBgAlt}, 0.02f);
}

float srgb(double linear) {
  const double clamped = std::clamp(linear, 0.0, 1.0);
  return static_cast<float>(clamped <= 0.0031308 ? 12.92 * clamped
                                                 : 1.055 * std::pow(clamped, 1 / 2.4) - 0.055);
}

ImU32 oklab_color(double lightness, double a, double b) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b),
               m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b),
               s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return ImGui::ColorConvertFloat4ToU32({srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                                         srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                                         srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 1});
}

constexpr std::size_t kRampColors = 256;

using Ramp = std::array<ImU32, kRampColors>;

/// @param low, high  Oklab lightness of its dark blue and its yellow end
Ramp make_ramp(double low, double high) {
  Ramp ramp{};
  for (std::size_t i = 0; i < kRampColors; ++i) {
    const double t = static_cast<double>(i) / (kRampColors - 1);
    const double lightness = std::lerp(low, high, t), hue = std::lerp(4.6, 1.85, t), chroma = 0.115;
    ramp[i] = oklab_color(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
  }
  return ramp;
}

}  // namespace

ImU32 ramp_color(double t) {
  static const Ramp kOnDark = make_ramp(0.42, 0.96), kOnLight = make_ramp(0.30, 0.82);
  const double place = t > 0 ? std::min(t, 1.0) : 0;
  const auto index = static_cast<std::size_t>(std::lround(place * (kRampColors - 1)));
  return applied == Theme::dark ? kOnDark[index] : kOnLight[kRampColors - 1 - index];
}

Theme in_force() { return applied; }

Role::operator ImU32() const { return applied == Theme::dark ? dark_ : light_; }

ImU32 chain_color(int chain) {
  static constexpr std::array kColors{Role{IM_COL32(86, 180, 233, 255), IM_COL32(0, 114, 178, 255)},
                                      Role{IM_COL32(240, 170, 50, 255), IM_COL32(214, 140, 0, 255)},
                                      Role{IM_COL32(60, 190, 140, 255), IM_COL32(0, 138, 100, 255)},
                                      Role{IM_COL32(224, 130, 180, 255), IM_COL32(190, 90, 145, 255)},
                                      Role{IM_COL32(240, 228, 90, 255), IM_COL32(168, 152, 0, 255)},
                                      Role{IM_COL32(110, 140, 230, 255), IM_COL32(70, 90, 200, 255)},
                                      Role{IM_COL32(232, 110, 60, 255), IM_COL32(196, 80, 0, 255)},
                                      Role{IM_COL32(190, 190, 195, 255), IM_COL32(90, 90, 95, 255)}};
  return kColors[static_cast<std::size_t>(chain) % kColors.size()];
}

void apply(float font_size, Theme theme) {
  applied = theme;
  ImGuiStyle& style = ImGui::GetStyle();
  apply_spacing(style, font_size);
  apply_colors(style);
}

}  // namespace patina::theme
