#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace patina {

/// What a program finds about it.
struct Surroundings {
  std::map<std::string, std::string> environment;  ///< set in addition to this process's own
  int inherited = -1;                              ///< a file descriptor that it keeps open; -1: none
  std::filesystem::path out, err;                  ///< what it prints goes there; empty: where this does
};

/// A program in a process of its own; killed, if it still runs, when this goes.
class Program {
 public:
  /// @param words  the program, found along PATH, and its arguments
  explicit Program(const std::vector<std::string>& words, const Surroundings& surroundings = {}) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that crashes leaves nothing behind
    for (const auto& [name, value] : surroundings.environment) ::setenv(name.c_str(), value.c_str(), 1);
    if (surroundings.inherited >= 0) ::fcntl(surroundings.inherited, F_SETFD, 0);
    redirect(surroundings.out, STDOUT_FILENO);
    redirect(surroundings.err, STDERR_FILENO);
    ::execvp(arguments.front(), arguments.data());
    ::_exit(127);
  }
  ~Program() { kill(); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t id() const { return id_; }
  void signal(int number) const { ::kill(id_, number); }

  /// @return its exit status, or -signal; nothing if it still goes on after so long
  std::optional<int> wait(std::chrono::seconds longest = std::chrono::minutes(1)) {
    const auto limit = std::chrono::steady_clock::now() + longest;
    int status = 0;
    while (::waitpid(id_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > limit) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    running_ = false;
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }

  void kill() {
    if (!std::exchange(running_, false)) return;
    signal(SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }

 private:
  static void redirect(const std::filesystem::path& file, int descriptor) {
    if (!file.empty()) ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
  }

  pid_t id_;
  bool running_ = true;
};

}  // namespace patina
