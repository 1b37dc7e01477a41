#include "engine/prediction/material_chooser.h"

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/random_access_file.h"
#include "engine/summary/network.h"
#include "engine/summary/safetensors.h"
#include "engine/summary/tensor_index.h"

namespace patina {

MaterialChooser MaterialChooser::load(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    throw UserError("The file " + file.string() + ", which tells materials apart, cannot be used: " + why +
                    "; reinstall Patina, or train it again (resources/predictors).");
  };
  const SafeTensors contents = read_safetensors(file);
  const auto entry = contents.metadata.find("patina_chooser");
  if (entry == contents.metadata.end()) refuse("it does not say that it is one");
  MaterialChooser chooser;
  const auto json = nlohmann::json::parse(entry->second, nullptr, false);
  try {
    if (json.at("format") != 2) refuse("it is of another version");
    if (json.at("network_sha256") != RandomAccessFile(bundled_network(), kMaxNetworkBytes).sha256_hex())
      refuse("it was trained with another bundled network");
    chooser.materials_ = json.at("materials").get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    refuse("its description lacks something");
  }
  chooser.network_ =
      DenseNetwork::read(contents, chooser.features_.size(), std::ssize(chooser.materials_), refuse);
  return chooser;
}

Eigen::VectorXd MaterialChooser::log_probabilities(const Image& photo) const {
  return softmax(network_(features_(photo))).array().max(1e-300).log();
}

std::filesystem::path bundled_chooser() { return data_directory() / "predictors" / "chooser.safetensors"; }

}  // namespace patina
