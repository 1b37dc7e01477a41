#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "engine/io/random_access_file.h"

namespace patina {

/// Bytes of a file.
struct FileSpan {
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

/// The entries of a zip archive that are stored as they are, as torch.save stores all of them (APPNOTE 6.3:
/// end of central directory, central directory, local headers). Every span lies within the file. Check sums
/// are not compared.
/// @throws UserError (refuse_network) for an archive that is damaged, compressed, or of more than one part
std::map<std::string, FileSpan> index_stored_zip(const RandomAccessFile& file);

}  // namespace patina
