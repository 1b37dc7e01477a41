#pragma once

#include <imgui.h>

namespace patina::theme {

// Neutral greys, so that colours of a material are judged against grey; one accent, the green of old copper.
// All colours are sRGB, as Dear ImGui takes them.
inline constexpr ImU32 kWindow = IM_COL32(24, 25, 26, 255);
inline constexpr ImU32 kPanel = IM_COL32(33, 34, 36, 255);
inline constexpr ImU32 kWell = IM_COL32(21, 22, 23, 255);  ///< behind plots and pictures
inline constexpr ImU32 kLine = IM_COL32(58, 60, 63, 255);
inline constexpr ImU32 kText = IM_COL32(226, 228, 229, 255);
inline constexpr ImU32 kMuted = IM_COL32(150, 154, 158, 255);
inline constexpr ImU32 kAccent = IM_COL32(88, 184, 160, 255);
inline constexpr ImU32 kWarning = IM_COL32(232, 176, 92, 255);
inline constexpr ImU32 kError = IM_COL32(226, 106, 92, 255);

/// A chain's colour, told apart by colour-blind eyes too (Okabe & Ito 2008, lightened for a dark ground).
ImU32 chain_color(int chain);

/// Low to high, t from 0 to 1, as a colour: from deep blue over green to pale yellow, lightness linear in t,
/// so that it reads the same to colour-blind eyes (a path through Oklab, Ottosson 2020).
ImU32 ramp_color(double t);

/// Sets Dear ImGui's colours and spacing. @param font_size pixels; all spacing grows with it
void apply(float font_size);

}  // namespace patina::theme
