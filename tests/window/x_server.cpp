#include "tests/window/x_server.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace patina {

XServer::XServer(std::unique_ptr<Program> program, std::string display)
    : program_(std::move(program)), display_(std::move(display)) {}

std::unique_ptr<XServer> XServer::start(int width, int height) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return nullptr;
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  auto program = std::make_unique<Program>(
      std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(pipe[1]), "-screen", "0", screen,
                               "-nolisten", "tcp"},
      Surroundings{.environment = {}, .inherited = pipe[1], .out = {}, .err = {}});
  ::close(pipe[1]);
  std::string number;  // it writes "7\n" once it can be connected to, and nothing if it fails
  for (char c = 0; ::read(pipe[0], &c, 1) == 1 && c != '\n';) number += c;
  ::close(pipe[0]);
  if (number.empty()) return nullptr;
  return std::unique_ptr<XServer>(new XServer(std::move(program), ":" + number));
}

}  // namespace patina
