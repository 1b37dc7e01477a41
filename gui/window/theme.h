#pragma once

#include <imgui.h>

namespace patina::theme {

enum class Theme { dark, light };

/// What a colour is for; what it is depends on the theme in force.
class Role {
 public:
  constexpr Role(ImU32 dark, ImU32 light) : dark_(dark), light_(light) {}
  operator ImU32() const;

 private:
  ImU32 dark_, light_;
};

// Neutral greys, so that colours of a material are judged against grey; one accent, the green of old copper.
// All colours are sRGB, as Dear ImGui takes them.
inline constexpr Role kWindow{IM_COL32(24, 25, 26, 255), IM_COL32(206, 208, 210, 255)};
inline constexpr Role kPanel{IM_COL32(33, 34, 36, 255), IM_COL32(232, 233, 234, 255)};
inline constexpr Role kWell{IM_COL32(21, 22, 23, 255), IM_COL32(248, 249, 249, 255)};  ///< behind plots
inline constexpr Role kLine{IM_COL32(58, 60, 63, 255), IM_COL32(188, 191, 194, 255)};
inline constexpr Role kGrid{IM_COL32(255, 255, 255, 16), IM_COL32(0, 0, 0, 22)};
inline constexpr Role kText{IM_COL32(226, 228, 229, 255), IM_COL32(30, 32, 34, 255)};
inline constexpr Role kMuted{IM_COL32(150, 154, 158, 255), IM_COL32(92, 96, 100, 255)};
inline constexpr Role kAccent{IM_COL32(88, 184, 160, 255), IM_COL32(14, 110, 88, 255)};
inline constexpr Role kAccentHovered{IM_COL32(108, 204, 180, 255), IM_COL32(34, 146, 120, 255)};
inline constexpr Role kAccentActive{IM_COL32(70, 160, 138, 255), IM_COL32(16, 108, 88, 255)};
inline constexpr Role kOnAccent{IM_COL32(16, 24, 22, 255), IM_COL32(255, 255, 255, 255)};
inline constexpr Role kWarning{IM_COL32(232, 176, 92, 255), IM_COL32(138, 80, 0, 255)};
inline constexpr Role kError{IM_COL32(240, 122, 108, 255), IM_COL32(184, 48, 36, 255)};
inline constexpr Role kBanner{IM_COL32(52, 47, 44, 255), IM_COL32(255, 246, 236, 255)};

/// A chain's colour, told apart by colour-blind eyes too (Okabe & Ito 2008, made lighter or darker than the
/// ground).
ImU32 chain_color(int chain);

/// Low to high, t from 0 to 1, as a colour: from deep blue over green to pale yellow, on a light ground the
/// other way and darker. Lightness is linear in t, so that it reads the same to colour-blind eyes (a path
/// through Oklab, Ottosson 2020).
ImU32 ramp_color(double t);

Theme in_force();

/// Sets Dear ImGui's colours and spacing. @param font_size pixels; all spacing grows with it
void apply(float font_size, Theme theme = Theme::dark);

}  // namespace patina::theme
