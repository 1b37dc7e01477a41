#include "gui/panels/photo_panel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "gui/panels/keys.h"
#include "gui/preview/clipping.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastView = 5, kMostView = 120;  // degrees

double field_of_view(const Capture& capture) {
  return 2 * std::atan(0.5 * capture.size_cm / capture.camera_cm) / kDegree;
}

/// What is shown: the whole photo where it is known.
const Image& shown_image(const Photo& photo) { return photo.whole.empty() ? photo.image : photo.whole; }

/// Pixels a side at which a run compares its renders with the photo.
int resolution_of(const Session& session) {
  return session.has_run() ? session.run().settings().resolution : session.settings().resolution;
}

ImGuiMouseCursor cursor_of(CropHandle handle) {
  switch (handle) {
    case CropHandle::inside:
      return ImGuiMouseCursor_ResizeAll;
    case CropHandle::top_left:
    case CropHandle::bottom_right:
      return ImGuiMouseCursor_ResizeNWSE;
    case CropHandle::top_right:
    case CropHandle::bottom_left:
      return ImGuiMouseCursor_ResizeNESW;
    case CropHandle::none:
      break;
  }
  return ImGuiMouseCursor_Arrow;
}

/// The largest rectangle of an image's shape in the middle of a room.
Rect fitted(const Rect& room, int width, int height) {
  const float scale =
      std::min(room.size.x / static_cast<float>(width), room.size.y / static_cast<float>(height));
  const ImVec2 size{std::floor(scale * static_cast<float>(width)),
                    std::floor(scale * static_cast<float>(height))};
  return {{std::floor(room.position.x + 0.5f * (room.size.x - size.x)),
           std::floor(room.position.y + 0.5f * (room.size.y - size.y))},
          size};
}

}  // namespace

void PhotoPanel::follow(const Session& session) {
  if (!session.has_photo() || version_ == session.photo_version()) return;
  const Image& image = shown_image(session.photo());
  const Image overlay = clipped_overlay(image);
  picture_ = Texture::picture(gl_, image);
  clipped_ = Texture::picture(gl_, overlay);
  clipped_share_ = covered_share(overlay);
  version_ = session.photo_version();
  // Another part of the same photo: the square that is being moved stays in hand.
  const std::tuple photo(session.photo_file(), session.photo().original_width,
                         session.photo().original_height);
  if (photo == followed_) return;
  followed_ = photo;
  handle_ = CropHandle::none;
  by_keys_.reset();
}

const Texture* PhotoPanel::compared(const Session& session) {
  if (!session.has_photo()) return nullptr;
  const std::pair version(session.run_version(), session.photo_version());
  if (!compared_ || version != compared_version_)
    compared_ = Texture::picture(gl_, session.has_run() ? session.run().photo() : session.photo().image);
  compared_version_ = version;
  return &*compared_;
}

void PhotoPanel::draw(const PanelContext& context, const Rect& rect, bool loading,
                      const std::function<void()>& ask_to_open) {
  const Session& session = context.session;
  const PanelScope panel("Photo", rect, context, ImGuiWindowFlags_NoScrollbar);
  follow(session);
  if (session.has_photo() || loading) {
    ImGui::SameLine();
    const std::string text = loading ? "Reading..." : session.photo_name();
    elided_text(text, ImGui::GetContentRegionAvail().x, theme::kMuted);
  }
  if (picture_) draw_controls(context);
  const Rect room{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()};
  if (!picture_) return draw_invitation(context, room, ask_to_open);
  draw_picture(context, room);
}

void PhotoPanel::draw_controls(const PanelContext& context) {
  RunChoices& choices = context.session.choices();
  const Capture capture = choices.settings().capture;
  const Photo& photo = context.session.photo();
  ImGui::SetNextItemWidth(0.46f * ImGui::GetContentRegionAvail().x);
  double view = field_of_view(capture);
  if (ImGui::InputDouble("##view", &view, 0, 0, "%.1f\u00b0 field of view",
                         ImGuiInputTextFlags_EnterReturnsTrue) &&
      view >= kLeastView && view <= kMostView) {
    const double camera = 0.5 * capture.size_cm / std::tan(0.5 * view * kDegree);
    context.commands.push_back([&choices, capture, camera] {
      choices.set_capture({capture.size_cm, camera});
    });
  }
  tooltip(std::string("How wide the camera saw the square: it was ") + number_text(capture.camera_cm, 3) +
          " cm above it. " +
          (photo.focal_pixels ? "The photo says so itself."
                              : "The photo does not say; this is what most phones have. ") +
          " Type degrees and press Enter; the next run takes it.");
  ImGui::SameLine();
  ImGui::Checkbox("Clipped", &shows_clipped_);
  tooltip("Marks what is too bright for the camera, " + number_text(100 * clipped_share_, 2) +
          " % of the picture: its true brightness is not known (C)");
  ImGui::SameLine();
  ImGui::Checkbox("Seen", &shows_seen_);
  tooltip("The square as the run sees it: " + std::to_string(resolution_of(context.session)) +
          " pixels a side. What is finer than that cannot be found out (V)");
}

void PhotoPanel::draw_seen(const Session& session) {
  const Photo& photo = session.photo();
  if (!shows_seen_ || !session.photo_is_current()) return;
  const std::pair version(session.photo_version(), resolution_of(session));
  if (!seen_ || version != seen_version_)
    seen_ = Texture::picture(gl_, resized(photo.image, std::min(version.second, photo.image.width)));
  seen_version_ = version;
  const PhotoCrop& crop = photo.crop;
  const float scale = place_.size.x / static_cast<float>(photo.original_width);
  const ImVec2 low{place_.position.x + scale * static_cast<float>(crop.x),
                   place_.position.y + scale * static_cast<float>(crop.y)};
  const float side = scale * static_cast<float>(crop.side);
  ImGui::GetWindowDrawList()->AddImage(seen_->imgui_id(), low, {low.x + side, low.y + side});
}

void PhotoPanel::draw_picture(const PanelContext& context, const Rect& room) {
  const Session& session = context.session;
  const Photo& photo = session.photo();
  place_ = fitted(room, picture_->width(), picture_->height());
  if (place_.size.x < 1 || place_.size.y < 1) return;
  const ImVec2 corner = place_.position, end{corner.x + place_.size.x, corner.y + place_.size.y};
  ImGui::SetCursorScreenPos(corner);
  mouse_area("photo", place_.size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(picture_->imgui_id(), corner, end);
  draw_seen(session);
  if (shows_clipped_) list.AddImage(clipped_->imgui_id(), corner, end);
  if (photo.whole.empty()) return tooltip("What the run compares its renders with");
  const float scale = place_.size.x / static_cast<float>(photo.original_width);
  handle_drag(context, scale);
  handle_keys(context);
  draw_square(by_keys_ ? *by_keys_ : handle_ != CropHandle::none ? dragged_ : session.chosen_crop(), scale);
  if (by_keys_) draw_help();
}

void PhotoPanel::draw_help() const {
  const char* help = "Arrows move, + and - resize,\nEnter keeps, Esc leaves";
  const float pad = 0.4f * ImGui::GetFontSize();
  const ImVec2 size = ImGui::CalcTextSize(help);
  const ImVec2 corner{place_.position.x + pad, place_.position.y + place_.size.y - size.y - 3 * pad};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x + 2 * pad, corner.y + size.y + 2 * pad},
                     IM_COL32(0, 0, 0, 190), pad);
  list.AddText({corner.x + pad, corner.y + pad}, IM_COL32_WHITE, help);
}

void PhotoPanel::take_keys(const Session& session, bool taken) {
  by_keys_.reset();
  if (taken) by_keys_ = session.chosen_crop();
}

void PhotoPanel::handle_keys(const PanelContext& context) {
  if (!by_keys_ || keys_are_elsewhere()) return;
  Session& session = context.session;
  const int width = session.photo().original_width, height = session.photo().original_height;
  const ImGuiIO& io = ImGui::GetIO();
  const int step = std::max(1, std::min(width, height) / (io.KeyShift ? 300 : 40));
  const ImVec2 arrows = pressed_arrows();
  if (arrows.x != 0 || arrows.y != 0)
    by_keys_ = dragged_crop(*by_keys_, CropHandle::inside, step * arrows.x, step * arrows.y, width, height);
  const auto typed = [&](char character) {
    return static_cast<int>(io.InputQueueCharacters.contains(static_cast<ImWchar>(character)));
  };
  if (const int grown = typed('+') + typed('=') - typed('-'); grown != 0)
    by_keys_ = resized_crop(*by_keys_, 2 * step * grown, width, height);
  if (!enter_pressed()) return;
  if (*by_keys_ != session.chosen_crop())
    context.commands.push_back([&session, crop = *by_keys_] { session.crop_to(crop); });
  by_keys_.reset();
}

void PhotoPanel::handle_drag(const PanelContext& context, float scale) {
  Session& session = context.session;
  const ImGuiIO& io = ImGui::GetIO();
  const double x = (io.MousePos.x - place_.position.x) / scale,
               y = (io.MousePos.y - place_.position.y) / scale;
  const CropHandle under = crop_handle_at(session.chosen_crop(), x, y, 0.8 * ImGui::GetFontSize() / scale);
  if (ImGui::IsItemActivated()) {
    handle_ = under;
    start_ = dragged_ = session.chosen_crop();
  }
  const CropHandle handle = handle_ != CropHandle::none ? handle_ : under;
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(cursor_of(handle));
  if (handle_ == CropHandle::none) {
    if (under != CropHandle::none && !ImGui::IsItemActive())
      tooltip(
          "Drag the square or its corners: what lies in it is compared with the renders, which take the "
          "camera to be above its middle");
    return;
  }
  const Photo& photo = session.photo();
  const ImVec2 clicked = io.MouseClickedPos[ImGuiMouseButton_Left];
  dragged_ = dragged_crop(start_, handle_, (io.MousePos.x - clicked.x) / scale,
                          (io.MousePos.y - clicked.y) / scale, photo.original_width, photo.original_height);
  if (ImGui::IsItemActive()) return;
  handle_ = CropHandle::none;
  if (dragged_ != start_) context.commands.push_back([&session, crop = dragged_] { session.crop_to(crop); });
}

void PhotoPanel::draw_square(const PhotoCrop& crop, float scale) const {
  const ImVec2 corner = place_.position, end{corner.x + place_.size.x, corner.y + place_.size.y};
  const ImVec2 low{corner.x + scale * static_cast<float>(crop.x),
                   corner.y + scale * static_cast<float>(crop.y)};
  const float side = scale * static_cast<float>(crop.side);
  const ImVec2 high{low.x + side, low.y + side};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 shade = IM_COL32(0, 0, 0, 150);
  list.AddRectFilled(corner, {end.x, low.y}, shade);
  list.AddRectFilled({corner.x, high.y}, end, shade);
  list.AddRectFilled({corner.x, low.y}, {low.x, high.y}, shade);
  list.AddRectFilled({high.x, low.y}, {end.x, high.y}, shade);
  list.AddRect(low, high, IM_COL32(255, 255, 255, 160));
  const float grip = 0.3f * ImGui::GetFontSize();
  for (const ImVec2 at : {low, ImVec2(high.x, low.y), ImVec2(low.x, high.y), high}) {
    const ImVec2 inner{at.x + (at.x == low.x ? grip : -grip), at.y + (at.y == low.y ? grip : -grip)};
    list.AddRectFilled({std::min(at.x, inner.x), std::min(at.y, inner.y)},
                       {std::max(at.x, inner.x), std::max(at.y, inner.y)}, IM_COL32(255, 255, 255, 220));
  }
}

void PhotoPanel::draw_invitation(const PanelContext& context, const Rect& room,
                                 const std::function<void()>& ask_to_open) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = room.position, size = room.size;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, theme::kWell, 0.4f * em);
  list.AddRect(corner, {corner.x + size.x, corner.y + size.y}, theme::kLine, 0.4f * em);
  centred_hint({corner, {size.x, size.y - 3 * em}}, "Drop a flash photo of a surface here");
  ImGui::SetCursorScreenPos({corner.x + 0.5f * (size.x - button_width("Open...")), corner.y + 0.5f * size.y});
  if (primary_button("Open...")) context.commands.push_back(ask_to_open);
}

}  // namespace patina
