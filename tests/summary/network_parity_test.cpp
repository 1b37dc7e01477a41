// Features against PyTorch in double precision (reference_features.py), from every layout a network comes in.
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/empty.h>

#include <cstdlib>
#include <filesystem>

#include "engine/io/random_access_file.h"
#include "engine/summary/network.h"
#include "resources/networks/distilled_vgg.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

constexpr std::int64_t kSide = 80;

class NetworkParity : public NetworkFiles {
 protected:
  static bool run_reference(const std::string& arguments) {
    const std::string script = std::string(PATINA_SOURCE_DIR) + "/tests/summary/reference_features.py";
    return std::system(("/usr/bin/python3 " + script + " " + arguments).c_str()) == 0;
  }
  static bool has_torch() {
    return std::system("/usr/bin/python3 -c 'import torch, numpy' 2>/dev/null") == 0;
  }

  at::Tensor raw(const std::string& name, at::IntArrayRef shape, at::ScalarType type) const {
    const RandomAccessFile file(folder_ / name, 1u << 30);
    at::Tensor tensor = at::empty(shape, type);
    EXPECT_EQ(file.size(), tensor.nbytes()) << name;
    file.read(0, std::min<std::size_t>(file.size(), tensor.nbytes()), tensor.data_ptr());
    return tensor;
  }

  /// The largest over the taps of |features - reference| / |reference|.
  double error(const Network& network) const {
    const at::NoGradGuard no_grad;
    const std::vector<at::Tensor> features =
        network.features(raw("image.f32", {1, 3, kSide, kSide}, at::kFloat));
    EXPECT_EQ(features.size(), 5u);
    double largest = 0;
    for (std::size_t k = 0; k < features.size(); ++k) {
      const at::Tensor reference =
          raw("features-" + std::to_string(k) + ".f64", features[k].sizes(), at::kDouble);
      const double difference = (features[k].to(at::kDouble) - reference).norm().item<double>();
      largest = std::max(largest, difference / reference.norm().item<double>());
    }
    return largest;
  }
};

TEST_F(NetworkParity, ARandomVgg19EqualsPyTorchInDoubleFromEveryLayout) {
  if (!has_torch()) GTEST_SKIP() << "needs python3-torch and python3-numpy";
  ASSERT_TRUE(run_reference("vgg19 " + folder_.string()));
  for (const char* name : {"vgg19.pth", "vgg19-legacy.pth", "vgg19.safetensors"})
    EXPECT_LT(error(Network::load(folder_ / name)), 1e-5) << name;
  std::filesystem::rename(folder_ / "vgg19.pth", folder_ / "vgg19-dcbb9e9d.pth");
  EXPECT_NE(user_error([&] { Network::load(folder_ / "vgg19-dcbb9e9d.pth"); }).find("SHA-256"),
            std::string::npos)
      << "these are not the published weights";
}

TEST_F(NetworkParity, ADistilledVgg19EqualsPyTorchInDouble) {
  const std::filesystem::path weights =
      std::filesystem::path(PATINA_SHARED_DIR) / "weights" / "vgg19_distilled_16x.safetensors";
  if (!std::filesystem::exists(weights)) GTEST_SKIP() << "no weights at " << weights;
  if (!has_torch()) GTEST_SKIP() << "needs python3-torch and python3-numpy";
  ASSERT_TRUE(run_reference("distilled " + weights.string() + " " + folder_.string()));
  EXPECT_LT(error(Network::load(file(describe_distilled_vgg(read_safetensors(weights))))), 1e-5);
}

}  // namespace
}  // namespace patina
