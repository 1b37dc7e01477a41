#pragma once

#include <memory>
#include <string>

#include "tests/support/program.h"

namespace patina {

/// A display without a screen (Xvfb), for as long as it lives.
class XServer {
 public:
  /// @return null where Xvfb is not installed or does not start
  static std::unique_ptr<XServer> start(int width, int height);

  const std::string& display() const { return display_; }  ///< ":7"

 private:
  XServer(std::unique_ptr<Program> program, std::string display);

  std::unique_ptr<Program> program_;
  std::string display_;
};

}  // namespace patina
