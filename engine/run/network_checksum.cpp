#include "engine/run/network_checksum.h"

#include "engine/io/file.h"
#include "engine/summary/network.h"

namespace patina {

std::string network_checksum(const std::filesystem::path& network) {
  constexpr std::size_t kLargestNetwork = 600u << 20;
  return sha256_hex(read_file(network.empty() ? bundled_network() : network, kLargestNetwork));
}

}  // namespace patina
