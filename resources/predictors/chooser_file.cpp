#include "resources/predictors/chooser_file.h"

#include <nlohmann/json.hpp>

#include "engine/io/random_access_file.h"
#include "engine/material/registry.h"
#include "engine/summary/network.h"
#include "engine/summary/tensor_index.h"

namespace patina {

SafeTensors chooser_file(const DenseStudent& student) {
  SafeTensors file = student.to_file();
  file.metadata["patina_chooser"] = nlohmann::ordered_json{
      {"format", 2},
      {"network_sha256", RandomAccessFile(bundled_network(), kMaxNetworkBytes).sha256_hex()},
      {"materials", material_names()}}.dump();
  return file;
}

}  // namespace patina
