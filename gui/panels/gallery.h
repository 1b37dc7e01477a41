#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gui/mode_finder.h"
#include "gui/panels/panel.h"
#include "gui/preview/thumbnails.h"

namespace patina {

/// What the gallery asks the program for.
struct GalleryActions {
  std::function<void(std::size_t draw)> export_draw;
  std::function<void()> export_starred;
};

/// Draws as pictures: those that the user starred, each with a note, and the best one of each kind of
/// solution. A click selects a draw; any two can be compared.
class Gallery {
 public:
  /// @param thumbnails  outlives the gallery  @param wake  called from other threads when there is news
  Gallery(Thumbnails& thumbnails, std::function<void()> wake)
      : thumbnails_(thumbnails), modes_(std::move(wake)) {}

  void draw(const PanelContext& context, const Rect& rect, const GalleryActions& actions);

  /// Where the picture of a draw was in the last frame, if it is in the gallery.
  std::optional<Rect> picture_of(std::size_t draw) const;
  const ModeFinder& modes() const { return modes_; }

 private:
  enum class Order { best, newest, oldest };
  struct Card {
    std::size_t draw = 0;
    std::optional<std::size_t> star;  ///< its index in the model, if it is one of the user's
    std::string caption;
  };
  struct Shown {
    std::size_t draw = 0;
    Rect picture;
  };

  std::vector<Card> starred(const ExplorerModel& model) const;
  std::vector<Card> modes(const ExplorerModel& model) const;
  void draw_head(const PanelContext& context, const GalleryActions& actions);
  void draw_comparison(Session& session);
  void draw_cards(const PanelContext& context, const std::vector<Card>& cards, const GalleryActions& actions);
  void draw_card(const PanelContext& context, const Card& card, const GalleryActions& actions);
  void draw_picture(Session& session, const Card& card);
  void draw_note(ExplorerModel& model, std::size_t star);
  void draw_buttons(const PanelContext& context, const Card& card, const GalleryActions& actions);

  Thumbnails& thumbnails_;
  ModeFinder modes_;
  int run_ = -1;
  Order order_ = Order::best;
  std::optional<std::size_t> a_, b_;      ///< the draws that are compared
  std::optional<std::size_t> annotated_;  ///< the star whose note is being typed
  std::string typed_;                     ///< the note as far as it is typed
  std::vector<Shown> shown_;              ///< in this frame
};

}  // namespace patina
