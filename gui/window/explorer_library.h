#pragma once

#include <future>

#include "gui/window/explorer.h"

namespace patina {

/// The explorer as it is loaded on a thread of its own; the destructor waits for that. The library stays
/// loaded.
class ExplorerLibrary {
 public:
  ExplorerLibrary();

  bool ready() const;
  /// Waits for it. Once. @throws std::runtime_error if the library is missing or broken
  Explore get() { return loading_.get(); }

 private:
  std::future<Explore> loading_;
};

}  // namespace patina
