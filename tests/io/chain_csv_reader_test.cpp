#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/io/chain_csv_fixture.h"
#include "tests/io/file_size_limit.h"

namespace patina {
namespace {

using Rows = std::vector<ChainCsvReader::Row>;

class ChainCsvReading : public ChainCsvFile {
 protected:
  /// A closed chain of warm-up and sampling rows.
  std::string write_chain(int warmup, int samples) const {
    ChainCsvWriter writer(path(), header(warmup, samples));
    for (int i = 0; i < warmup; ++i) writer.append(row(i));
    if (warmup > 0) writer.adaptation_terminated(0.25, {1, 2, 3});
    for (int i = warmup; i < warmup + samples; ++i) writer.append(row(i));
    writer.close();
    return slurp(path());
  }
  void expect_rows(const Rows& rows, int warmup, int total) const {
    ASSERT_EQ(std::ssize(rows), total);
    for (int i = 0; i < total; ++i) {
      EXPECT_TRUE(same(rows[static_cast<std::size_t>(i)].row, row(i))) << i;
      EXPECT_EQ(rows[static_cast<std::size_t>(i)].warmup, i < warmup) << i;
    }
  }
  std::string refusal(const std::string& text) const {
    return user_error([&] { ChainCsvReader(file("bad.csv", text)).read_new(); });
  }
};

TEST_F(ChainCsvReading, GivesBackExactlyWhatWasWritten) {
  for (const int warmup : {0, 4}) {
    write_chain(warmup, 20);
    ChainCsvReader reader(path());
    EXPECT_FALSE(reader.has_header());
    expect_rows(reader.read_new(), warmup, warmup + 20);
    ASSERT_TRUE(reader.has_header());
    const ChainCsvHeader expected = header(warmup, 20);
    EXPECT_EQ(reader.header().model, expected.model);
    EXPECT_EQ(reader.header().id, expected.id);
    EXPECT_EQ(reader.header().seed, expected.seed);
    EXPECT_EQ(reader.header().num_warmup, warmup);
    EXPECT_EQ(reader.header().num_samples, 20);
    EXPECT_EQ(reader.header().names, expected.names);
    EXPECT_TRUE(reader.closed());
    EXPECT_TRUE(reader.read_new().empty());
  }
}

TEST_F(ChainCsvReading, LeavesTheRestForLaterOnceThereAreEnough) {
  const std::string text = write_chain(4, 20'000);
  ChainCsvReader reader(path());
  Rows all;
  for (int portions = 0; !reader.closed(); ++portions) {
    ASSERT_LT(portions, 20);
    const Rows rows = reader.read_new(2000);
    EXPECT_LT(rows.size(), 6000u) << "a portion is not the whole";
    EXPECT_LE(reader.bytes_read(), std::ssize(text));
    all.insert(all.end(), rows.begin(), rows.end());
  }
  expect_rows(all, 4, 20'004);
  EXPECT_GT(reader.bytes_read(), std::ssize(text) - 10) << "all but the footer";
}

TEST_F(ChainCsvReading, ExtremeNumbersSurvive) {
  using Limits = std::numeric_limits<double>;
  ChainCsvWriter writer(path(), header(0, 1));
  writer.append({-Limits::infinity(),
                 Limits::quiet_NaN(),
                 Limits::infinity(),
                 2147483646,
                 true,
                 Limits::max(),
                 {Limits::denorm_min(), std::nextafter(1.0, 2.0), -Limits::min()}});
  const Rows rows = ChainCsvReader(path()).read_new();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].row.lp, -Limits::infinity());
  EXPECT_TRUE(std::isnan(rows[0].row.accept_stat));
  EXPECT_EQ(rows[0].row.stepsize, Limits::infinity());
  EXPECT_EQ(rows[0].row.n_leapfrog, 2147483646);
  EXPECT_EQ(rows[0].row.energy, Limits::max());
  EXPECT_EQ(rows[0].row.values,
            (std::vector{Limits::denorm_min(), std::nextafter(1.0, 2.0), -Limits::min()}));
}

TEST_F(ChainCsvReading, AFileThatGrowsByOneByteAtATimeNeverShowsHalfARow) {
  const std::string whole = write_chain(3, 5);
  const auto growing = folder_ / "growing.csv";
  std::ofstream out(growing, std::ios::binary);
  ChainCsvReader reader(growing);
  Rows rows;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    out << whole[length] << std::flush;
    const Rows fresh = reader.read_new();
    EXPECT_TRUE(fresh.empty() || whole[length] == '\n');
    rows.insert(rows.end(), fresh.begin(), fresh.end());
  }
  expect_rows(rows, 3, 8);
  EXPECT_TRUE(reader.closed());
}

TEST_F(ChainCsvReading, AHalfLineThatTheWriterTakesBackIsForgotten) {
  ChainCsvWriter writer(path(), header(0, 9));
  writer.append(row(0));
  ChainCsvReader reader(path());
  Rows rows = reader.read_new();
  std::ofstream(path(), std::ios::app) << "-0.14285714285714285,0.5,0.";  // as a full disk would leave it
  EXPECT_TRUE(reader.read_new().empty());
  writer.append(row(1));  // over it
  writer.close();
  for (const auto& fresh : reader.read_new()) rows.push_back(fresh);
  expect_rows(rows, 0, 2);
  EXPECT_TRUE(reader.closed());
}

TEST_F(ChainCsvReading, FollowsAChainThatIsTakenUpAgainAfterItWasClosed) {
  ChainCsvPlace place;
  {
    ChainCsvWriter writer(path(), header(0, 3));
    for (int i = 0; i < 3; ++i) writer.append(row(i));
    place = writer.place();
    writer.close();
  }
  ChainCsvReader reader(path());
  Rows rows = reader.read_new();
  EXPECT_TRUE(reader.closed());
  ChainCsvWriter writer(path(), header(0, 6), place);
  for (int i = 3; i < 6; ++i) writer.append(row(i));
  for (const auto& fresh : reader.read_new()) rows.push_back(fresh);
  expect_rows(rows, 0, 6);
  EXPECT_FALSE(reader.closed());
}

TEST_F(ChainCsvReading, AMissingFooterOrAHalfHeaderIsNoError) {
  std::string text = write_chain(0, 6);
  text.resize(text.find("\n#\n") + 1);
  ChainCsvReader cut(file("cut.csv", text));
  expect_rows(cut.read_new(), 0, 6);
  EXPECT_FALSE(cut.closed());
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, text.find("lp__") + 9}) {
    ChainCsvReader half(file("half.csv", text.substr(0, length)));
    EXPECT_TRUE(half.read_new().empty());
    EXPECT_FALSE(half.has_header());
  }
}

TEST_F(ChainCsvReading, ALargeFileIsReadWhole) {
  write_chain(100, 20'000);  // some megabytes: many reads, with lines across their borders
  expect_rows(ChainCsvReader(path()).read_new(), 100, 20'100);
}

TEST_F(ChainCsvReading, WhatIsNoChainFileIsRefusedWithTheLine) {
  std::string good = write_chain(0, 3);
  good.resize(good.find("\n#\n") + 1);
  const auto lines = std::ranges::count(good, '\n');
  const std::string next = "line " + std::to_string(lines + 1) + ":";
  for (const char* bad : {"1,2,3\n", "0,1,1,1,1,0,0,1,2,x\n", "0,1,1,1,1,0,0,1,2,\n",
                          "0,1,1,1,1,0,0,1,2,3,4\n", "\x01\x02\n", "0,1,1,1,-1,0,0,1,2,3\n",
                          "0,1,1,1,1e99,0,0,1,2,3\n", "0,1,1,1,nan,0,0,1,2,3\n", "0x1,1,1,1,1,0,0,1,2,3\n"})
    EXPECT_NE(refusal(good + bad).find(next), std::string::npos) << bad;
  EXPECT_NE(refusal("hello\n").find("line 1:"), std::string::npos);
  EXPECT_NE(refusal("lp__,a,b,c,d,e,energy__\n"), "");
  EXPECT_NE(refusal(good + std::string(3 << 20, 'x')).find("too long"), std::string::npos);
  EXPECT_EQ(refusal(good + "0,1,1,1,1,0,0,\x1B[2J,2,3\n").find('\x1B'), std::string::npos);
}

TEST_F(ChainCsvReading, ABadLineIsReportedAgainAtTheSamePlace) {
  const std::string good = write_chain(0, 3);
  ChainCsvReader reader(file("bad.csv", good.substr(0, good.find("\n#\n") + 1) + "nonsense\n"));
  const std::string first = user_error([&] { reader.read_new(); });
  EXPECT_NE(first, "");
  EXPECT_EQ(user_error([&] { reader.read_new(); }), first);
}

TEST_F(ChainCsvReading, AMissingFileOrAFolderIsAUserError) {
  EXPECT_NE(user_error([&] { ChainCsvReader(folder_ / "none.csv").read_new(); }), "");
  EXPECT_NE(user_error([&] { ChainCsvReader(folder_).read_new(); }), "");
}

}  // namespace
}  // namespace patina
