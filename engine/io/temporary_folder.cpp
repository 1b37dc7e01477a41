#include "engine/io/temporary_folder.h"

#include <stdlib.h>

#include <string>
#include <system_error>

#include "engine/error.h"

namespace patina {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "patina-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw UserError("Cannot make a temporary folder: point TMPDIR to a place that can be written.");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace patina
