#include "gui/panels/export_form.h"

#include <array>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr std::array kFormats{"PNG, 8 bit", "PNG, 16 bit", "OpenEXR"};  // in the order of MapFormat
constexpr std::array kNormals{"OpenGL normals", "DirectX normals"};

template <typename Choice, std::size_t n>
void draw_choice(const char* label, const std::array<const char*, n>& words, Choice& choice) {
  if (!ImGui::BeginCombo(label, words[static_cast<std::size_t>(choice)])) return;
  for (std::size_t i = 0; i < n; ++i)
    if (ImGui::Selectable(words[i], static_cast<std::size_t>(choice) == i)) choice = static_cast<Choice>(i);
  ImGui::EndCombo();
}

}  // namespace

float ExportForm::height() const {
  const auto files = static_cast<float>(exported_files(format_, normals_).size());
  return ImGui::GetFrameHeightWithSpacing() + files * ImGui::GetTextLineHeightWithSpacing() +
         2 * ImGui::GetStyle().ItemSpacing.y;
}

void ExportForm::draw() {
  draw_choices();
  draw_files();
}

void ExportForm::draw_choices() {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(8.5f * em);
  draw_choice("##format", kFormats, format_);
  tooltip(
      "8 bit is small but shows steps in slopes and heights; 16 bit does not; OpenEXR holds linear colours "
      "and heights in centimetres");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(10.5f * em);
  draw_choice("##normals", kNormals, normals_);
  tooltip("OpenGL for Blender, Houdini and glTF: green leans up. DirectX for Unreal: green leans down");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(6.2f * em);
  draw_resolution_choice("##pixels", {512, 1024, 2048, 4096}, resolution_);
  tooltip("Pixels a side of the maps");
  ImGui::SameLine();
  ImGui::Checkbox("Repeats", &tile_);
  tooltip(
      "Maps that repeat without a seam. They may show more than the photographed sample; maps.json says how "
      "many centimetres. A glow, which has one middle, cannot repeat");
}

void ExportForm::draw_files() const {
  for (const ExportedFile& file : exported_files(format_, normals_)) {
    ImGui::TextUnformatted(file.name.c_str());
    ImGui::SameLine(9.5f * ImGui::GetFontSize());
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
    ImGui::TextUnformatted(file.description.c_str());
    ImGui::PopStyleColor();
  }
}

void ExportForm::complete(ExportRequest& request) const {
  request.format = format_;
  request.normals = normals_;
  request.resolution = resolution_;
  request.tile = tile_;
}

}  // namespace patina
