#include "engine/run/network_checksum.h"

#include "engine/io/file.h"
#include "engine/summary/network.h"

namespace patina {

std::string network_checksum(const std::filesystem::path& network) {
  constexpr std::size_t kLargestNetwork = 600u << 20;
  const std::filesystem::path file = network.empty() ? bundled_network() : network;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  return sha256_hex(read_file(file, kLargestNetwork));
}

}  // namespace patina
