#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "engine/summary/safetensors.h"

namespace patina {

/// A test with an empty folder of its own.
class NetworkFiles : public ::testing::Test {
 protected:
  std::filesystem::path file(std::string_view bytes) const {
    const std::filesystem::path path = folder_ / "network.safetensors";
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  std::filesystem::path file(const SafeTensors& contents) const {
    const std::filesystem::path path = folder_ / "network.safetensors";
    write_safetensors(path, contents);
    return path;
  }

 private:
  TemporaryFolder temporary_;

 protected:
  const std::filesystem::path& folder_ = temporary_.path();
};

/// Values from N(0, scale^2), the same for the same seed.
at::Tensor random_tensor(at::IntArrayRef shape, unsigned seed, double scale = 1);

/// A small network with everything the format knows: three convolutions, one of them without ReLU and one
/// 5 x 5, both poolings, a tap of the trunk itself and one through two convolutions aside.
SafeTensors small_network();

/// The same weights under another description of the layers (JSON).
SafeTensors with_layers(const std::string& layers);

/// The UserError's message that an action throws, "" if it throws none; it must be one line and a sentence.
template <typename Action>
std::string user_error(Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with('.')) << message;
    EXPECT_LT(message.size(), 400u) << message;
    return message;
  }
  return {};
}

}  // namespace patina
