#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "engine/io/temporary_folder.h"

namespace patina {

/// A test with an empty folder of its own.
class FolderTest : public ::testing::Test {
 protected:
  /// Writes bytes to a file in the folder; returns its path.
  std::filesystem::path file(const std::string& name, std::string_view bytes) const {
    std::filesystem::remove(folder_ / name);  // some file systems wait for the disk when one is overwritten
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

 private:
  TemporaryFolder temporary_;

 protected:
  const std::filesystem::path& folder_ = temporary_.path();
};

/// All bytes of a file, by another route than the engine's.
inline std::string slurp(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The one-sentence message of the UserError that an action throws; empty if it throws none. A message that
/// is not one line, or does not end as a sentence does, fails the test.
template <typename Action>
std::string user_error(Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with('.')) << message;
    return message;
  }
  return {};
}

/// Runs an action in a child process of its own; returns what it returns, or -signal if a signal killed it.
template <typename Action>
int exit_status_of(Action&& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action());
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace patina
