#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/io/folder_test.h"

namespace patina {

/// patina-cli of this build: it lies beside the test.
inline std::filesystem::path cli_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "patina-cli";
}

struct Finished {
  int status = 0;  ///< exit status, or -signal
  std::string out, err;
};

/// A patina-cli in a process of its own; killed, if it still runs, when this goes.
class CliProcess {
 public:
  /// @param arguments  without the program's name   @param folder  where stdout and stderr are kept
  CliProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder)
      : out_(folder / "stdout.txt"), err_(folder / "stderr.txt") {
    const std::string program = cli_program().string();
    std::vector<char*> words{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    redirect(out_, STDOUT_FILENO);
    redirect(err_, STDERR_FILENO);
    ::execv(program.c_str(), words.data());
    ::_exit(127);
  }
  ~CliProcess() {
    if (!running_) return;
    signal(SIGKILL);
    wait();
  }
  CliProcess(const CliProcess&) = delete;
  CliProcess& operator=(const CliProcess&) = delete;

  pid_t id() const { return id_; }
  void signal(int number) const { ::kill(id_, number); }
  std::string err() const { return slurp(err_); }

  /// Waits for its end, two minutes at most: then it is killed, and the test fails.
  Finished wait() {
    int status = 0;
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (::waitpid(id_, &status, WNOHANG) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (std::chrono::steady_clock::now() < limit) continue;
      ADD_FAILURE() << "patina-cli does not end: " << err();
      signal(SIGKILL);
      ::waitpid(id_, &status, 0);
      break;
    }
    running_ = false;
    return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), slurp(out_), slurp(err_)};
  }

 private:
  static void redirect(const std::filesystem::path& file, int descriptor) {
    ::dup2(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
  }

  std::filesystem::path out_, err_;
  pid_t id_;
  bool running_ = true;
};

/// Waits up to a minute. Returns whether it came true.
template <typename Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 6000; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
    if (condition()) return true;
  return false;
}

}  // namespace patina
