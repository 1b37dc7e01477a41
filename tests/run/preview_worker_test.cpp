#include "engine/run/preview_worker.h"

#include <atomic>

#include "tests/run/run_fixture.h"

namespace patina {
namespace {

PreviewRequest request_at(const ParameterValues& values, int resolution) {
  return {"bump", 3, Capture{}, values, resolution};
}

class PreviewWorkerTest : public ::testing::Test {
 protected:
  Renderer renderer_{"bump", 3, Capture{}};
  ParameterValues values_ = prior_location(renderer_.table());

  static std::optional<Preview> wait_for(PreviewWorker& worker, std::uint64_t ticket) {
    std::optional<Preview> newest;
    comes_true([&] {
      if (auto preview = worker.take()) newest = std::move(preview);
      return newest && newest->ticket == ticket;
    });
    return newest;
  }
};

TEST_F(PreviewWorkerTest, MakesTheMapsOfTheRequest) {
  std::atomic<int> wakes{0};
  PreviewWorker worker([&] { ++wakes; });
  const auto preview = wait_for(worker, worker.request(request_at(values_, 64)));
  ASSERT_TRUE(preview);
  const MaterialMaps direct = renderer_.maps(values_, 64);
  EXPECT_EQ(preview->maps.height.pixels, direct.height.pixels);
  EXPECT_EQ(preview->maps.base_color.pixels, direct.base_color.pixels);
  EXPECT_EQ(preview->request.values, values_);
  EXPECT_TRUE(comes_true([&] { return wakes == 1; }));
  EXPECT_FALSE(worker.take());
  EXPECT_EQ(worker.error_of(preview->ticket), "");
}

TEST_F(PreviewWorkerTest, TheNewestRequestWinsAndOlderOnesAreDropped) {
  std::atomic<int> wakes{0};
  PreviewWorker worker([&] { ++wakes; });
  std::uint64_t last = 0;
  for (int i = 0; i < 200; ++i) {
    values_.continuous[0] = 1000 + i;
    const std::uint64_t ticket = worker.request(request_at(values_, 256));
    EXPECT_GT(ticket, last);
    last = ticket;
  }
  const auto preview = wait_for(worker, last);
  ASSERT_TRUE(preview);
  EXPECT_EQ(preview->request.values.continuous[0], 1199);
  EXPECT_LT(wakes, 200);
}

TEST_F(PreviewWorkerTest, SaysWhyThereIsNoPreviewAndGoesOn) {
  PreviewWorker worker;
  PreviewRequest unknown = request_at(values_, 64);
  unknown.material = "nosuch";
  const std::uint64_t failing = worker.request(unknown);
  ASSERT_TRUE(comes_true([&] { return !worker.error_of(failing).empty(); }));
  EXPECT_NE(worker.error_of(failing).find("nosuch"), std::string::npos);
  const auto next = wait_for(worker, worker.request(request_at(values_, 64)));
  ASSERT_TRUE(next);
  EXPECT_EQ(worker.error_of(next->ticket), "") << "a request is not blamed for the one before";
}

TEST_F(PreviewWorkerTest, MayBeDestroyedWhileItWorks) {
  PreviewWorker worker;
  worker.request(request_at(values_, 512));
}

}  // namespace
}  // namespace patina
