#pragma once

#include <string>
#include <vector>

#include "gui/panels/panel.h"

namespace patina {

/// The one place where sentences for the user appear: what went wrong, and what a photo's reader noticed.
class ErrorBanner {
 public:
  enum class Kind { error, notice };

  void show(Kind kind, std::string sentence);
  void dismiss() { messages_.clear(); }
  bool visible() const { return !messages_.empty(); }

  /// The newest sentence; empty if none is shown.
  std::string sentence() const { return messages_.empty() ? std::string() : messages_.back().sentence; }

  /// At the bottom of the window, over everything else.
  void draw(const PanelContext& context, ImVec2 window_size);

 private:
  struct Message {
    Kind kind;
    std::string sentence;
  };
  std::vector<Message> messages_;
};

}  // namespace patina
