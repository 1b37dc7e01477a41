#include "gui/window/fonts.h"

#include <imgui_freetype.h>

#include <filesystem>
#include <string>
#include <vector>

namespace patina {
namespace {

// Pairs of first and last code point, ended by 0.
constexpr ImWchar kLetters[] = {0x20,   0xff,        // Latin-1
                                0x370,  0x3ff,       // Greek
                                0x2000, 0x206f, 0};  // dashes, quotes, ellipsis
constexpr ImWchar kSymbols[] = {0x2070, 0x209f,      // superscripts and subscripts
                                0x2190, 0x2199,      // arrows
                                0x221e, 0x221e,      // infinity
                                0x2248, 0x2248,      // about equal
                                0x2260, 0x2265,      // unequal, at most, at least
                                0x25a0, 0x25cf,      // squares, triangles, discs
                                0x2713, 0x2717, 0};  // ticks and crosses

using Paths = std::vector<std::filesystem::path>;

Paths existing(const Paths& candidates) {
  Paths found;
  std::error_code ignored;
  for (const auto& file : candidates) {
    if (std::filesystem::is_regular_file(file, ignored)) found.push_back(file);
  }
  return found;
}

/// One font from the first file that exists; the others lend the glyphs it lacks.
ImFont* add_font(const Paths& candidates, float pixels) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  ImFont* font = nullptr;
  for (const auto& file : existing(candidates)) {
    for (const ImWchar* ranges : {kLetters, kSymbols}) {
      config.MergeMode = font != nullptr;
      font = atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, ranges);
    }
  }
  if (font) return font;
  config.SizePixels = pixels;
  return atlas.AddFontDefault(&config);
}

}  // namespace

Fonts load_fonts(float size, float pixel_density) {
  const std::filesystem::path inter = "/usr/share/fonts/opentype/inter";
  const std::filesystem::path dejavu = "/usr/share/fonts/truetype/dejavu";
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  const float pixels = size * pixel_density;
  const Fonts fonts{add_font({inter / "Inter-Regular.otf", dejavu / "DejaVuSans.ttf"}, pixels),
                    add_font({inter / "Inter-SemiBold.otf", dejavu / "DejaVuSans-Bold.ttf"}, pixels)};
  io.FontDefault = fonts.regular;
  io.FontGlobalScale = 1 / pixel_density;
  return fonts;
}

}  // namespace patina
