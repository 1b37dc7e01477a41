#include "engine/run/network_checksum.h"

#include "engine/io/random_access_file.h"
#include "engine/summary/network.h"
#include "engine/summary/tensor_index.h"

namespace patina {

std::string network_checksum(const std::filesystem::path& network) {
  const std::filesystem::path file = network.empty() ? bundled_network() : network;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  return RandomAccessFile(file, kMaxNetworkBytes).sha256_hex();
}

}  // namespace patina
