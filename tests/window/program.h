#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace patina {

/// A program in a process of its own; killed, if it still runs, when this goes.
class Program {
 public:
  /// @param words        the program, found along PATH, and its arguments
  /// @param environment  set in addition to this process's own
  /// @param inherited    a file descriptor that it keeps open; -1: none
  Program(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
          int inherited = -1);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits for its end, a minute at most. @return its exit status; nothing if it goes on or was killed
  std::optional<int> wait();

 private:
  pid_t id_;
  bool running_ = true;
};

}  // namespace patina
