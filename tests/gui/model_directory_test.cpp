#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "gui/directory_listing.h"
#include "gui/run_factory.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

class Folder : public ::testing::Test {
 protected:
  void touch(const std::string& name) const { std::ofstream(path_ / name) << ' '; }

  TemporaryFolder folder_;
  fs::path path_ = folder_.path();
};

TEST_F(Folder, ListsFoldersThenRunsThenImagesAndNothingElse) {
  fs::create_directory(path_ / "zebra");
  fs::create_directory(path_ / "a run");
  fs::create_directory(path_ / ".hidden");
  for (const char* name : {"b.JPG", "a.png", "notes.txt", ".secret.png", "a run/run.json"}) touch(name);
  fs::create_symlink("/nowhere", path_ / "broken.png");
  std::vector<std::string> names;
  for (const DirectoryEntry& entry : list_directory(path_)) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"zebra", "a run", "a.png", "b.JPG"}));
  EXPECT_EQ(list_directory(path_)[1].kind, DirectoryEntry::Kind::run);
}

TEST_F(Folder, ThatIsNotThereIsAUserError) { EXPECT_THROW(list_directory(path_ / "no"), UserError); }

TEST_F(Folder, TypedPathsStartAtHomeHereOrTheRoot) {
  setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(typed_path(" ~/a.png ", path_), "/home/someone/a.png");
  EXPECT_EQ(typed_path("sub/../b.png", path_), path_ / "b.png");
  EXPECT_EQ(typed_path("/etc", path_), "/etc");
  EXPECT_EQ(typed_path("  ", path_), path_);
  EXPECT_EQ(typed_path("~x", path_), path_ / "~x");
}

TEST_F(Folder, FreshRunDirectoriesNeverCollide) {
  const fs::path first = fresh_run_directory(path_, "oak", "bump");
  EXPECT_TRUE(first.filename().string().starts_with("oak-bump-"));
  fs::create_directories(first);
  fs::path second = fresh_run_directory(path_, "oak", "bump");
  EXPECT_NE(first, second);
  EXPECT_FALSE(fs::exists(second));
}

TEST_F(Folder, ARunsDirectoryNamesItsPhotoHoweverOftenItIsGoneOnFrom) {
  const fs::path first = fresh_run_directory(path_, "oak door-2", "bump");
  fs::create_directories(first);
  const fs::path second = fresh_run_directory(path_, "oak door-2", "bump");
  EXPECT_EQ(photo_name_of(first), "oak door-2");
  EXPECT_EQ(photo_name_of(second), "oak door-2");
  EXPECT_EQ(photo_name_of(path_ / "my-bump-run"), "my-bump-run");
}

TEST_F(Folder, RunsGoWhereTheDesktopKeepsData) {
  setenv("XDG_DATA_HOME", path_.c_str(), 1);
  EXPECT_EQ(default_runs_directory(), path_ / "patina" / "runs");
  unsetenv("XDG_DATA_HOME");
  setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(default_runs_directory(), "/home/someone/.local/share/patina/runs");
}

}  // namespace
}  // namespace patina
