#pragma once

#include <imgui.h>

#include "gui/explorer_model.h"
#include "gui/window/theme.h"

namespace patina {

/// What colour a draw has in the plots, by the user's choice.
class DrawColours {
 public:
  /// Takes up the theme, the model's choice and the range that its draws have by now.
  /// @param run  tells one run's draws from another's
  void follow(const ExplorerModel& model, int run);

  ImU32 of(const ExplorerModel& model, std::size_t draw) const;

  /// The parameter, or the match, that colours show on a scale; its ends are those of range().
  bool is_scale() const;
  const Colouring& colouring() const { return colouring_; }
  const PlotRange& range() const { return range_; }

  /// Whether all draws have the colours that they had then.
  bool operator==(const DrawColours&) const = default;

 private:
  Colouring colouring_;
  PlotRange range_;
  int run_ = -1;
  theme::Theme theme_ = theme::Theme::dark;
};

}  // namespace patina
