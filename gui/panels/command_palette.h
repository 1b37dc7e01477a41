#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gui/action.h"
#include "gui/panels/panel.h"

namespace patina {

/// Every action by its name: type a few letters of it, press Enter.
class CommandPalette {
 public:
  void open();
  void close() { visible_ = false; }
  bool visible() const { return visible_; }

  /// Draws it if visible; what is chosen is carried out as a command.
  void draw(const PanelContext& context, const std::vector<Action>& actions);

 private:
  std::vector<const Action*> matches(const std::vector<Action>& actions) const;
  void move_choice(std::size_t count);
  void choose(const PanelContext& context, const Action& action);

  bool visible_ = false;
  bool focus_ = false;
  std::string typed_;
  std::size_t choice_ = 0;  ///< among the matches
};

}  // namespace patina
