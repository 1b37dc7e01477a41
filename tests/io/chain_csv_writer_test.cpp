#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <regex>

#include "tests/io/chain_csv_fixture.h"
#include "tests/io/file_size_limit.h"

namespace patina {
namespace {

class ChainCsvWriting : public ChainCsvFile {
 protected:
  /// A whole chain: two rows of warm-up, three of sampling although five were asked for.
  std::vector<std::string> whole_chain() const {
    ChainCsvWriter writer(path(), header(2, 5));
    for (int i = 0; i < 2; ++i) writer.append(row(i));
    writer.adaptation_terminated(0.25, {1, 0.5, 1.0 / 3});
    for (int i = 2; i < 5; ++i) writer.append(row(i));
    writer.close();
    return lines_of(slurp(path()));
  }
};

std::ptrdiff_t position(const std::vector<std::string>& lines, const std::string& line) {
  return std::ranges::find(lines, line) - lines.begin();
}

/// The text behind "key = " in the comment lines, without padding; CmdStan's readers take it so.
std::string setting(const std::vector<std::string>& lines, const std::string& key) {
  const std::regex form("# *" + key + " = (.*?) *");
  std::smatch match;
  for (const std::string& line : lines)
    if (std::regex_match(line, match, form)) return match[1];
  return "missing";
}

TEST_F(ChainCsvWriting, StatesTheSettingsThatCmdStansReadersLookUp) {
  const auto lines = whole_chain();
  EXPECT_EQ(setting(lines, "stan_version_major"), "2");
  EXPECT_EQ(setting(lines, "model"), "patina_leather");
  EXPECT_EQ(setting(lines, "method"), "sample (Default)");
  EXPECT_EQ(setting(lines, "num_warmup"), "2");
  EXPECT_EQ(setting(lines, "save_warmup"), "1");
  EXPECT_EQ(setting(lines, "thin"), "1 (Default)");
  EXPECT_EQ(setting(lines, "metric"), "diag_e (Default)");
  EXPECT_EQ(setting(lines, "max_depth"), "10");
  EXPECT_EQ(setting(lines, "id"), "3");
  EXPECT_EQ(setting(lines, "seed"), "18446744073709551615");
}

TEST_F(ChainCsvWriting, CountsTheRowsAfterWarmupInPlaceWhenItCloses) {
  ChainCsvWriter writer(path(), header(2, 5));
  EXPECT_EQ(setting(lines_of(slurp(path())), "num_samples"), "5");
  const auto lines = whole_chain();
  EXPECT_EQ(setting(lines, "num_samples"), "3");
  EXPECT_EQ(std::ranges::count_if(lines, [](const std::string& line) { return line[0] != '#'; }), 1 + 2 + 3);
}

TEST_F(ChainCsvWriting, PutsColumnsRowsAdaptationAndFooterInCmdStansOrder) {
  const auto lines = whole_chain();
  const auto columns = position(
      lines, "lp__,accept_stat__,stepsize__,treedepth__,n_leapfrog__,divergent__,energy__,light,rough,cells");
  ASSERT_LT(columns, std::ssize(lines));
  EXPECT_TRUE(std::all_of(lines.begin(), lines.begin() + columns,
                          [](const std::string& line) { return line.starts_with("# "); }));
  const auto adapted = position(lines, "# Adaptation terminated");
  ASSERT_EQ(adapted, columns + 1 + 2);
  EXPECT_EQ(lines[adapted + 1], "# Step size = 0.25");
  EXPECT_EQ(lines[adapted + 2], "# Diagonal elements of inverse mass matrix:");
  EXPECT_EQ(lines[adapted + 3], "# 1, 0.5, 0.3333333333333333");
  const auto footer = position(lines, "#");  // the first empty comment ends the body for some readers
  ASSERT_EQ(footer, adapted + 4 + 3);
  EXPECT_EQ(std::ssize(lines), footer + 1);
}

TEST_F(ChainCsvWriting, WritesCountsAndChoicesAsIntegersAndTheRestInShortestForm) {
  ChainCsvWriter writer(path(), header(0, 1));
  const double infinity = std::numeric_limits<double>::infinity();
  writer.append({-0.1, std::nan(""), infinity, 7, true, -infinity, {1e300, 0.5, 2}});
  writer.append({0, 1, 0.25, 1, false, 5e-324, {-0.0, 1.0 / 3, 0}});
  const auto lines = lines_of(slurp(path()));
  EXPECT_EQ(lines[lines.size() - 2], "-0.1,nan,inf,1,7,1,-inf,1e+300,0.5,2");
  EXPECT_EQ(lines[lines.size() - 1], "0,1,0.25,1,1,0,5e-324,-0,0.3333333333333333,0");
}

TEST_F(ChainCsvWriting, LeavesEachWholeLineInTheFileAtOnce) {
  ChainCsvWriter writer(path(), header(0, 10));
  auto size = slurp(path()).size();
  for (int i = 0; i < 10; ++i) {
    writer.append(row(i));
    const std::string text = slurp(path());
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(size), text.end(), '\n'), 1);
    size = text.size();
  }
}

TEST_F(ChainCsvWriting, OnAFullDiskThrowsKeepsWholeLinesAndCanGoOn) {
  std::string undisturbed;
  {
    ChainCsvWriter writer(path(), header(0, 200));
    for (int i = 0; i < 200; ++i) writer.append(row(i));
    writer.close();
    undisturbed = slurp(path());
  }
  ChainCsvWriter writer(path(), header(0, 200));
  int failures = 0;
  for (int i = 0; i < 200; ++i) {
    if (i % 40 == 39) {
      // Room for a part of the row: the kernel writes it, and the rest fails.
      const FileSizeLimit limit(std::filesystem::file_size(path()) + 7);
      EXPECT_NE(user_error([&] { writer.append(row(i)); }).find("disk is full"), std::string::npos);
      EXPECT_EQ(slurp(path()).back(), '\n');
      ++failures;
    }
    writer.append(row(i));
  }
  {
    const FileSizeLimit limit(std::filesystem::file_size(path()) + 1);
    EXPECT_NE(user_error([&] { writer.close(); }), "");
  }
  writer.close();
  EXPECT_EQ(failures, 5);
  EXPECT_EQ(slurp(path()), undisturbed);
}

/// Two rows of warm-up, then rows up to `rows`, from wherever the writer is.
void write_rows(ChainCsvWriter& writer, int begin, int end, const std::function<ChainCsvRow(int)>& row) {
  for (int i = begin; i < end; ++i) {
    if (i == 2 && !writer.place().adapted) writer.adaptation_terminated(0.25, {1, 0.5, 1.0 / 3});
    writer.append(row(i));
  }
}

TEST_F(ChainCsvWriting, GoesOnFromAnyPlaceToTheBytesOfAFileWrittenAtOnceAlsoForMoreRows) {
  std::string at_once;
  {
    ChainCsvWriter writer(path(), header(2, 18));
    write_rows(writer, 0, 20, row);
    writer.close();
    at_once = slurp(path());
  }
  for (int stop = 0; stop < 20; ++stop) {
    ChainCsvPlace place;
    {
      ChainCsvWriter writer(path(), header(2, 9));  // fewer were asked for at first
      write_rows(writer, 0, stop, row);
      place = writer.place();
      write_rows(writer, stop, stop + 3, [](int) { return row(77); });  // not to be kept
      writer.close();
    }
    ChainCsvWriter writer(path(), header(2, 18), place);
    EXPECT_EQ(writer.place(), place);
    write_rows(writer, stop, 20, row);
    writer.close();
    EXPECT_EQ(slurp(path()), at_once) << "stopped after row " << stop;
  }
}

TEST_F(ChainCsvWriting, DoesNotGoOnWithAFileThatIsShorterOrAnothers) {
  ChainCsvPlace place;
  {
    ChainCsvWriter writer(path(), header(0, 9));
    writer.append(row(1));
    place = writer.place();
  }
  const std::string before = slurp(path());
  ChainCsvPlace beyond = place;
  ++beyond.bytes;
  EXPECT_NE(user_error([&] { ChainCsvWriter(path(), header(0, 9), beyond); }).find("shorter"),
            std::string::npos);
  ChainCsvHeader other = header(0, 9);
  other.seed = 5;
  EXPECT_NE(user_error([&] { ChainCsvWriter(path(), other, place); }).find("is not the chain file"),
            std::string::npos);
  EXPECT_NE(user_error([&] { ChainCsvWriter(folder_ / "none.csv", other, place); }), "");
  EXPECT_EQ(slurp(path()), before);
}

TEST_F(ChainCsvWriting, ToADeviceThatIsAlwaysFullOrAPlaceThatIsNotThereIsAUserError) {
  EXPECT_NE(user_error([&] { ChainCsvWriter("/dev/full", header(0, 1)); }).find("disk is full"),
            std::string::npos);
  EXPECT_NE(user_error([&] { ChainCsvWriter(folder_ / "no" / "c.csv", header(0, 1)); }), "");
}

}  // namespace
}  // namespace patina
