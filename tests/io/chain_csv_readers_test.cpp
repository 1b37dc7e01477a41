#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "engine/io/chain_csv.h"
#include "tests/io/folder_test.h"

namespace patina {
namespace {

class ChainCsvReaders : public FolderTest {
 protected:
  static constexpr int kRows = 3000;

  static ChainCsvHeader header() { return {"patina_bump", 1, 7, 0, kRows, {"x", "y"}}; }
  static ChainCsvRow row(int i) {
    ChainCsvRow row;
    row.lp = -i / 7.0;
    row.values = {i / 3.0, 1e-9 * i};
    return row;
  }
  std::filesystem::path path() const { return folder_ / "chain-1.csv"; }

  /// Writes all rows; every now and then it closes the file and takes it up again a few rows further back.
  void write() const {
    ChainCsvPlace place;
    int back = 0;
    for (int i = 0; i < kRows;) {
      ChainCsvWriter writer =
          i == 0 ? ChainCsvWriter(path(), header()) : ChainCsvWriter(path(), header(), place);
      i = back;
      const int end = std::min(kRows, i + 400);
      for (; i < end; ++i) {
        if (i == end - 60) {
          place = writer.place();
          back = i;
        }
        writer.append(row(i));
      }
      if (end != kRows) writer.close();
    }
  }
};

TEST_F(ChainCsvReaders, TwoSeeEveryRowOnceAndWholeWhileAWriterAppendsAndTakesTheFileUpAgain) {
  { ChainCsvWriter(path(), header()); }
  std::atomic<int> right{0};
  const auto follow = [&](int pause_us) {
    ChainCsvReader reader(path());
    for (int next = 0; next < kRows;) {
      for (const auto& fresh : reader.read_new()) {
        right += fresh.row.lp == row(next).lp && fresh.row.values == row(next).values;
        ++next;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(pause_us));
    }
  };
  std::vector<std::jthread> threads;
  threads.emplace_back(follow, 50);
  threads.emplace_back(follow, 700);
  threads.emplace_back([this] { write(); });
  threads.clear();
  EXPECT_EQ(right, 2 * kRows);
}

}  // namespace
}  // namespace patina
