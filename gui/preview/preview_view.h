#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "gui/preview/orbit.h"

namespace patina {

/// What the preview shows of a draw.
enum class Subject { photographed, plane, sphere, cloth, base_color, normal, roughness, height };
inline constexpr std::array kSubjects{Subject::photographed, Subject::plane,      Subject::sphere,
                                      Subject::cloth,        Subject::base_color, Subject::normal,
                                      Subject::roughness,    Subject::height};

/// How a render is set against the photo.
enum class Comparison { off, wipe, side_by_side, difference, flicker };
inline constexpr std::array kComparisons{Comparison::off, Comparison::wipe, Comparison::side_by_side,
                                         Comparison::difference, Comparison::flicker};

bool is_shape(Subject subject);  ///< a lit one
bool is_map(Subject subject);

const char* subject_text(Subject subject);           ///< "As shot"
const char* comparison_text(Comparison comparison);  ///< "Side by side"

/// How the preview is looked at: all that its controls change. No ImGui, no GL.
struct PreviewView {
  static constexpr float kMostStops = 6;
  static constexpr float kLeastGain = 1, kMostGain = 32;

  Subject subject = Subject::photographed;
  Comparison comparison = Comparison::off;
  float wipe = 0.5f;  ///< the photo's share, from the left
  float stops = 0;    ///< exposure of photo and render alike
  float gain = 4;     ///< of a difference
  bool signed_difference = false;
  Orbit orbit;
  Eigen::Vector3f light = light_under(-0.5f, 0.5f);  ///< in the camera's frame
  int resolution = 512;                              ///< of the maps, pixels a side

  /// What is compared: nothing but the render as photographed can be set against the photo.
  Comparison effective_comparison() const;
  /// Asks for a comparison; shows the render as photographed for it.
  void compare(Comparison wanted);
  /// Moves the border between photo and render; shows both if need be. @param share  clamped to [0, 1]
  void wipe_to(float share);
  void expose(float change);  ///< by so many stops, within the limits

  bool operator==(const PreviewView&) const = default;
};

/// Whether flicker shows the photo at this time. @param seconds  on any clock
bool flicker_shows_photo(double seconds);
/// Seconds between the changes.
inline constexpr double kFlickerSeconds = 0.6;

}  // namespace patina
