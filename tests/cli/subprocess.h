#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/io/folder_test.h"
#include "tests/support/comes_true.h"
#include "tests/support/program.h"

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
      : out_(folder / "stdout.txt"),
        err_(folder / "stderr.txt"),
        program_(words(arguments), {.environment = {}, .inherited = -1, .out = out_, .err = err_}) {}

  pid_t id() const { return program_.id(); }
  void signal(int number) const { program_.signal(number); }
  std::string err() const { return slurp(err_); }

  /// Waits for its end, two minutes at most: then it is killed, and the test fails.
  Finished wait() {
    const auto status = program_.wait(std::chrono::minutes(2));
    if (!status) {
      ADD_FAILURE() << "patina-cli does not end: " << err();
      program_.kill();
    }
    return {status.value_or(-SIGKILL), slurp(out_), slurp(err_)};
  }

 private:
  static std::vector<std::string> words(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), cli_program().string());
    return arguments;
  }

  std::filesystem::path out_, err_;
  Program program_;
};

}  // namespace patina
