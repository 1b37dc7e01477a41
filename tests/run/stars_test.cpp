#include "engine/run/stars.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/temporary_folder.h"

namespace patina {
namespace {

class StarsTest : public ::testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(file_) << text; }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "stars.json";
};

TEST_F(StarsTest, ComeBackAsTheyWereInTheirOrder) {
  const std::vector<Star> stars{{3, 12'345'678'901, "darker \"oak\"\nsecond line \u00e9"}, {0, 0, ""}};
  write_stars(folder_.path(), stars);
  EXPECT_EQ(read_stars(folder_.path()), stars);
  write_stars(folder_.path(), {});
  EXPECT_TRUE(read_stars(folder_.path()).empty());
}

TEST_F(StarsTest, OfARunWithoutAnyAreNone) { EXPECT_TRUE(read_stars(folder_.path()).empty()); }

TEST_F(StarsTest, ADamagedFileIsRefusedAndKeptWhenANewOneIsWritten) {
  for (const char* text :
       {"", "{", "[]", R"({"format":1})", R"({"format":1,"stars":[{"chain":0,"iteration":1,"note":""}]})",
        R"({"format":1,"stars":[{"chain":1,"iteration":-1,"note":""}]})",
        R"({"format":1,"stars":[{"chain":"1","iteration":1,"note":""}]})", R"({"format":2,"stars":[]})"}) {
    write(text);
    EXPECT_THROW(read_stars(folder_.path()), UserError) << text;
    write_stars(folder_.path(), {{1, 2, "new"}});
    EXPECT_EQ(read_file(file_.string() + ".damaged"), text);
    EXPECT_EQ(read_stars(folder_.path()).size(), 1u);
  }
}

TEST_F(StarsTest, ANoteOfBrokenTextIsKeptAsFarAsItIsText) {
  write_stars(folder_.path(), {{0, 0, "caf\xe9"}});
  EXPECT_EQ(read_stars(folder_.path()).at(0).note, "caf\ufffd");
}

TEST_F(StarsTest, AFolderThatCannotBeWrittenIsSaidSo) {
  EXPECT_THROW(write_stars(folder_.path() / "missing", {{0, 0, ""}}), UserError);
}

}  // namespace
}  // namespace patina
