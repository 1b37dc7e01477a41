#include "gui/preview/preview_view.h"

#include <algorithm>
#include <cmath>

namespace patina {

bool is_shape(Subject subject) {
  return subject == Subject::plane || subject == Subject::sphere || subject == Subject::cloth;
}

bool is_map(Subject subject) { return subject >= Subject::base_color; }

const char* subject_text(Subject subject) {
  switch (subject) {
    case Subject::photographed:
      return "As shot";
    case Subject::plane:
      return "On a plane";
    case Subject::sphere:
      return "On a ball";
    case Subject::cloth:
      return "On cloth";
    case Subject::base_color:
      return "Base colour";
    case Subject::normal:
      return "Normals";
    case Subject::roughness:
      return "Roughness";
    case Subject::height:
      return "Height";
  }
  return "";
}

const char* comparison_text(Comparison comparison) {
  switch (comparison) {
    case Comparison::off:
      return "Alone";
    case Comparison::wipe:
      return "Wipe";
    case Comparison::side_by_side:
      return "Side by side";
    case Comparison::difference:
      return "Difference";
    case Comparison::flicker:
      return "Flicker";
  }
  return "";
}

Comparison PreviewView::effective_comparison() const {
  return subject == Subject::photographed ? comparison : Comparison::off;
}

void PreviewView::compare(Comparison wanted) {
  comparison = wanted;
  if (wanted != Comparison::off) subject = Subject::photographed;
}

void PreviewView::wipe_to(float share) {
  compare(Comparison::wipe);
  wipe = std::clamp(share, 0.0f, 1.0f);
}

void PreviewView::expose(float change) { stops = std::clamp(stops + change, -kMostStops, kMostStops); }

bool flicker_shows_photo(double seconds) {
  return static_cast<long long>(std::floor(seconds / kFlickerSeconds)) % 2 != 0;
}

}  // namespace patina
