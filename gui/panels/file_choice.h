#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gui/panels/panel.h"

namespace patina {

/// Asks which of several files that were dropped at once is meant.
class FileChoice {
 public:
  void ask(std::vector<std::filesystem::path> files);
  bool visible() const { return !files_.empty(); }
  void close() { files_.clear(); }

  /// Draws it if visible. @return the file that was chosen, once
  std::optional<std::filesystem::path> draw(const PanelContext& context);

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace patina
