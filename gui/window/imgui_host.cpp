#include "gui/window/imgui_host.h"

#include <cstdint>
#include <vector>

namespace patina {
ImguiContext::ImguiContext() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  // The program's own layout is fixed; no file is written beside the user's work.
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
}

ImguiContext::~ImguiContext() { ImGui::DestroyContext(); }

void draw_frame(ImguiRenderer& renderer) {
  ImGui::Render();
  renderer.render(*ImGui::GetDrawData());
}

Image read_frame(const Gl& gl, ImguiRenderer& renderer) {
  const ImDrawData& data = *ImGui::GetDrawData();
  renderer.render(data);
  Image image(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
              static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y), 3);
  std::vector<std::uint8_t> bytes(image.pixels.size());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row) {
    const std::size_t from = (static_cast<std::size_t>(image.height) - 1 - row) * stride;
    for (std::size_t i = 0; i < stride; ++i) {
      image.pixels[row * stride + i] = static_cast<float>(bytes[from + i]) / 255;
    }
  }
  return image;
}

}  // namespace patina
