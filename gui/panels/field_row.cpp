#include "gui/panels/field_row.h"

#include "gui/panels/panel.h"

namespace patina {

void begin_field(const char* label, const char* what) {
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  tooltip(what);
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
}

}  // namespace patina
