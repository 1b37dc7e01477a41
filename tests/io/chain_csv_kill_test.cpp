#include <sys/mman.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/io/chain_csv_fixture.h"

namespace patina {
namespace {

using namespace std::chrono_literals;

/// A counter that a child process shares with the test.
class SharedCounter {
 public:
  SharedCounter()
      : memory_(::mmap(nullptr, sizeof(Count), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        count_(new (memory_) Count(0)) {}
  ~SharedCounter() { ::munmap(memory_, sizeof(Count)); }
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;
  std::atomic<int>& operator*() const { return *count_; }

 private:
  using Count = std::atomic<int>;
  void* memory_;
  Count* count_;
};

class ChainCsvKilled : public ChainCsvFile {
 protected:
  /// Starts a process that writes rows without end and counts those that append() has returned from.
  pid_t start_writer(std::atomic<int>& appended) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ChainCsvWriter writer(path(), header(0, 1'000'000));
    for (int i = 0;; ++i) {
      writer.append(row(i));
      appended = i + 1;
    }
  }
};

TEST_F(ChainCsvKilled, AtAnyMomentNoRowIsLostOrHalf) {
  for (int repeat = 0; repeat < 10; ++repeat) {
    const SharedCounter appended;
    *appended = 0;
    std::filesystem::remove(path());
    const pid_t child = start_writer(*appended);
    while (*appended == 0) std::this_thread::sleep_for(100us);
    ChainCsvReader reader(path());
    int read = 0;
    const auto follow = [&] {
      for (const auto& fresh : reader.read_new()) ASSERT_TRUE(same(fresh.row, row(read++))) << "row " << read;
    };
    for (int look = 0; look < 5 + repeat; ++look) {
      follow();
      std::this_thread::sleep_for(std::chrono::microseconds(137 * repeat));
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    follow();
    EXPECT_GE(read, *appended) << "a row was lost that had been appended";
    EXPECT_LE(read, *appended + 1);
    EXPECT_GT(read, 0);
    EXPECT_FALSE(reader.closed());
  }
}

}  // namespace
}  // namespace patina
