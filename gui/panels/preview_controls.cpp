#include "gui/panels/preview_controls.h"

namespace patina {
namespace {

void draw_subject(PreviewView& view) {
  if (ImGui::BeginCombo("##subject", subject_text(view.subject))) {
    for (const Subject subject : kSubjects) {
      if (ImGui::Selectable(subject_text(subject), subject == view.subject)) view.subject = subject;
      if (subject == Subject::photographed || subject == Subject::cloth) ImGui::Separator();
    }
    ImGui::EndCombo();
  }
  tooltip(
      "What to show of this draw: the sample as the camera saw it, the material on a shape under a lamp that "
      "follows the mouse, or one of its maps (keys 1 to 8)");
}

void draw_comparison(PreviewView& view) {
  if (ImGui::BeginCombo("##comparison", comparison_text(view.effective_comparison()))) {
    for (const Comparison comparison : kComparisons) {
      if (ImGui::Selectable(comparison_text(comparison), comparison == view.effective_comparison()))
        view.compare(comparison);
    }
    ImGui::EndCombo();
  }
  tooltip("How to set the render against the photo (R, W, N, D, F)");
}

void draw_exposure(PreviewView& view) {
  ImGui::DragFloat("##exposure", &view.stops, 0.02f, -PreviewView::kMostStops, PreviewView::kMostStops,
                   view.stops == 0 ? "Exposure" : "%+.1f stops", ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) view.stops = 0;
  tooltip(
      "Drag: brightness of photo and render alike, in stops; +1 doubles the light (keys - and +, 0 resets). "
      "Right click: as it was");
}

}  // namespace

void draw_preview_controls(PreviewView& view, bool has_photo) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x - 2 * gap;
  ImGui::SetNextItemWidth(0.36f * room);
  draw_subject(view);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(0.36f * room);
  ImGui::BeginDisabled(!has_photo);
  draw_comparison(view);
  ImGui::EndDisabled();
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-1);
  draw_exposure(view);
}

void draw_difference_controls(PreviewView& view) {
  const char* sides = "Which is brighter";
  const float check =
      ImGui::CalcTextSize(sides).x + ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - check);
  ImGui::SliderFloat("##gain", &view.gain, PreviewView::kLeastGain, PreviewView::kMostGain,
                     "%.0f times enlarged", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  tooltip("How much the difference is enlarged to be seen");
  ImGui::SameLine();
  ImGui::Checkbox(sides, &view.signed_difference);
  tooltip(
      "Grey where both are alike, brighter where the render is brighter, darker where the photo is. "
      "Otherwise "
      "black where both are alike");
}

void draw_preview_resolution(PreviewView& view, float width) {
  align_right(width);
  ImGui::SetNextItemWidth(width);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  draw_resolution_choice("##resolution", {256, 512, 1024, 2048, 4096}, view.resolution);
  ImGui::PopStyleVar();
  tooltip("Pixels a side of the render; the pattern stays the same");
}

}  // namespace patina
