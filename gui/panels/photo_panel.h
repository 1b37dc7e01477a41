#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

#include "gui/crop_drag.h"
#include "gui/gl/objects.h"
#include "gui/panels/panel.h"

namespace patina {

/// The photo with the square that is compared with the renders, which can be dragged; its field of view, and
/// what is clipped in it.
class PhotoPanel {
 public:
  explicit PhotoPanel(const Gl& gl) : gl_(gl) {}

  /// @param ask_to_open  carried out as a command where the user asks for another photo
  /// @param loading      another photo, or another part of it, is being read
  void draw(const PanelContext& context, const Rect& rect, bool loading,
            const std::function<void()>& ask_to_open);

  /// What renders are compared with: the run's photo, or without a run the chosen square. Null: none yet.
  const Texture* compared(const Session& session);

  void show_clipped(bool shown) { shows_clipped_ = shown; }
  bool shows_clipped() const { return shows_clipped_; }
  void show_seen(bool shown) { shows_seen_ = shown; }  ///< the square as coarse as the run compares it
  bool shows_seen() const { return shows_seen_; }

  /// Moves the square by keys from now on, or no more and leaves it as it was: arrows move it, by less with
  /// Shift, + and - resize it, Enter keeps it.
  void take_keys(const Session& session, bool taken);
  bool takes_keys() const { return by_keys_.has_value(); }

  /// Where the photo was in the last frame.
  const Rect& place() const { return place_; }

 private:
  void follow(const Session& session);
  void draw_invitation(const PanelContext& context, const Rect& room,
                       const std::function<void()>& ask_to_open);
  void draw_controls(const PanelContext& context);
  void draw_picture(const PanelContext& context, const Rect& room);
  void draw_help() const;
  void draw_square(const PhotoCrop& crop, float scale) const;
  void draw_seen(const Session& session);
  void handle_drag(const PanelContext& context, float scale);
  void handle_keys(const PanelContext& context);

  const Gl& gl_;
  std::optional<Texture> picture_;  ///< the whole photo, or the square where there is nothing else
  std::optional<Texture> clipped_;  ///< an overlay of the same size
  std::optional<Texture> compared_;
  int version_ = 0;                                       ///< of the photo in picture_
  std::tuple<std::filesystem::path, int, int> followed_;  ///< file, width and height of the photo in picture_
  std::pair<int, int> compared_version_{0, 0};            ///< run and photo
  double clipped_share_ = 0;                              ///< of the picture's pixels
  bool shows_clipped_ = false;
  std::optional<Texture> seen_;
  std::pair<int, int> seen_version_{0, 0};  ///< photo and pixels a side
  bool shows_seen_ = false;
  Rect place_;
  CropHandle handle_ = CropHandle::none;  ///< while it is dragged
  PhotoCrop start_, dragged_;
  std::optional<PhotoCrop> by_keys_;  ///< the square while keys move it
};

}  // namespace patina
