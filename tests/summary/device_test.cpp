// Summaries whose network runs on a graphics card, against the same on the processor.
#include "engine/summary/device.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/stack.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/summary/summary.h"
#include "tests/summary/gradients.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

TEST(Device, OneThatIsNotAtHandIsRefusedInASentence) {
  if (is_at_hand(Device::cuda)) GTEST_SKIP() << "this machine has CUDA";
  EXPECT_NE(user_error([] {
              make_summary("gram", {}, Precision::float32, Device::cuda);
            }).find("leave the device at cpu"),
            std::string::npos);
  EXPECT_NE(user_error([] { device_named("abacus"); }).find("use cpu or cuda"), std::string::npos);
}

class OnCuda : public NetworkFiles {
 protected:
  void SetUp() override {
    if (!is_at_hand(Device::cuda)) GTEST_SKIP() << "no graphics card for CUDA here";
  }

  /// A summary of two images, and the gradient of a random linear functional of it.
  struct Seen {
    at::Tensor values, gradient;
  };

  static Seen seen(const Summary& summary) {
    const at::Tensor images = at::stack({random_image(64, 3), random_image(64, 4)}).set_requires_grad(true);
    const at::Tensor values = summary.of(images);
    (values * random_tensor(values.sizes().vec(), 5)).sum().backward();
    return {values.detach(), images.grad()};
  }

  static double apart(const at::Tensor& a, const at::Tensor& b) {
    return ((a - b).norm() / b.norm()).item<double>();
  }
};

TEST_F(OnCuda, SummariesAndGradientsAreThoseOfTheProcessorAndComeBackToMainMemory) {
  for (const auto& network : {std::filesystem::path(), file(small_network())})
    for (const std::string name : {"gram", "gram+covariances+rings", "bands"}) {
      const Seen there = seen(*make_summary(name, network, Precision::float32, Device::cuda));
      const Seen here = seen(*make_summary(name, network));
      EXPECT_TRUE(there.values.is_cpu() && there.gradient.is_cpu());
      EXPECT_LT(apart(there.values, here.values), 1e-5) << name;
      EXPECT_LT(apart(there.gradient, here.gradient), 1e-4) << name;
    }
}

TEST_F(OnCuda, InBfloat16TheyAreOffByItsRounding) {
  const Seen exact = seen(*make_summary("gram", {}));
  const Seen rounded = seen(*make_summary("gram", {}, Precision::bfloat16, Device::cuda));
  EXPECT_GT(apart(rounded.values, exact.values), 1e-5);
  EXPECT_LT(apart(rounded.values, exact.values), 1e-2);
}

TEST_F(OnCuda, TheSameCallTwiceGivesTheSameBits) {
  const auto summary = make_summary("gram+covariances", {}, Precision::float32, Device::cuda);
  const Seen once = seen(*summary), again = seen(*summary);
  EXPECT_TRUE(once.values.equal(again.values));
  EXPECT_TRUE(once.gradient.equal(again.gradient));
}

}  // namespace
}  // namespace patina
