// Writes network files:
//   make-network OUT.safetensors                       the bundled network
//   make-network --from-distilled IN OUT.safetensors   a distilled VGG-19, described for patina-cli --network
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "engine/summary/network.h"
#include "resources/networks/bundled_design.h"
#include "resources/networks/distilled_vgg.h"

int main(int argc, char** argv) {
  using namespace patina;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() == 1 && !arguments[0].starts_with("-")) {
      write_safetensors(arguments[0], bundled_design());
    } else if (arguments.size() == 3 && arguments[0] == "--from-distilled") {
      write_safetensors(arguments[2], describe_distilled_vgg(read_safetensors(arguments[1])));
    } else {
      std::fprintf(stderr, "Usage: make-network [--from-distilled IN] OUT\n");
      return 2;
    }
    Network::load(arguments.back());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
