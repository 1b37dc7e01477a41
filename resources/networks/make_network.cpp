// Describes a distilled VGG-19, as published, for patina-cli --network:
//   make-network --from-distilled IN OUT.safetensors
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "engine/summary/network.h"
#include "resources/networks/distilled_vgg.h"

int main(int argc, char** argv) {
  using namespace patina;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() != 3 || arguments[0] != "--from-distilled") {
    std::fprintf(stderr, "Usage: make-network --from-distilled IN OUT\n");
    return 2;
  }
  try {
    write_safetensors(arguments[2], describe_distilled_vgg(read_safetensors(arguments[1])));
    Network::load(arguments[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
