#include "tests/window/program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace patina {

Program::Program(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
                 int inherited) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  id_ = ::fork();
  if (id_ != 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that crashes leaves nothing behind
  for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (inherited >= 0) ::fcntl(inherited, F_SETFD, 0);
  ::execvp(arguments.front(), arguments.data());
  ::_exit(127);
}

Program::~Program() {
  if (!running_) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

std::optional<int> Program::wait() {
  for (int i = 0; i < 6000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) == 0) continue;
    running_ = false;
    return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace patina
