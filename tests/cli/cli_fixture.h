#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/subprocess.h"

namespace patina {

/// A test that runs patina-cli in an empty folder.
class CliTest : public FolderTest {
 protected:
  Finished run(const std::vector<std::string>& arguments) const {
    return CliProcess(arguments, folder_).wait();
  }

  /// Runs what must succeed; its standard output.
  std::string output(const std::vector<std::string>& arguments) const {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    return finished.out;
  }

  nlohmann::json json(const std::vector<std::string>& arguments) const {
    return nlohmann::json::parse(output(arguments));
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A small render of the material bump; its path.
  std::string photo() const {
    output(
        {"render", "--material", "bump", "--z-seed", "2", "--resolution", "48", "--out", path("photo.png")});
    return path("photo.png");
  }

  /// A fit that takes a second or two, into the directory `name`.
  std::vector<std::string> small_fit(const std::string& photo, const std::string& name) const {
    return {"fit",      photo, "--material", "bump", "--summary", "means", "--resolution", "32",
            "--chains", "2",   "--warmup",   "40",   "--draws",   "30",    "--out",        path(name)};
  }
};

}  // namespace patina
