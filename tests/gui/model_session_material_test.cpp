#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "engine/material/registry.h"
#include "gui/session.h"
#include "tests/gui/session_fixture.h"

namespace patina {
namespace {

using testing::SessionTest;

std::optional<MaterialRanking> leather_alone() {
  RankedMaterial leather;
  leather.material = "leather";
  leather.match = prior_location(material_table("leather"));
  return MaterialRanking{{leather}, "gram", "leather, the only one compared."};
}

TEST_F(SessionTest, ChoosesTheMaterialThatIsFoundAndKeepsWhyWithTheRun) {
  RankSettings asked;
  RunFactory factory = this->factory();
  factory.rank = [&](const Image& photo, const RankSettings& settings, auto&&...) {
    EXPECT_EQ(photo.width, 40);
    asked = settings;
    return leather_alone();
  };
  Session session(factory, folder_.path() / "runs", {});
  session.open(photo_);
  session.choices().set_size_cm(12);
  session.find_material();
  for (int i = 0; i < 1000 && session.hint() == nullptr; ++i) {
    session.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_NE(session.hint(), nullptr);
  EXPECT_EQ(asked.capture.size_cm, 12);
  EXPECT_EQ(session.settings().material, "leather");
  session.start();  // the fake run makes no directory: that its reasons cannot be kept does not end it
  EXPECT_TRUE(session.has_run());
  factory_makes_directories_ = true;
  session.start();
  EXPECT_TRUE(std::filesystem::exists(session.run().directory() / "ranking.json"));
  session.choices().set_size_cm(13);
  EXPECT_EQ(session.hint(), nullptr) << "of another size it says nothing";
  session.choices().undo();
  EXPECT_NE(session.hint(), nullptr);
  session.open(photo_);
  EXPECT_EQ(session.hint(), nullptr) << "of another photo it says nothing";
}

class SessionLooksForTheMaterial : public SessionTest {
 protected:
  /// With a session that finds leather in every photo.
  std::unique_ptr<Session> session() {
    RunFactory factory = this->factory();
    factory.rank = [this](auto&&...) {
      ++looks_;
      return leather_alone();
    };
    return std::make_unique<Session>(factory, folder_.path() / "runs", std::function<void()>());
  }

  /// Until nothing is looked for any more.
  static void poll_until_found(Session& session) {
    for (int i = 0; i < 1000 && session.finder().busy(); ++i) {
      session.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(session.finder().busy());
  }

  std::atomic<int> looks_ = 0;
};

TEST_F(SessionLooksForTheMaterial, OfEveryPhotoWhileNobodyHasChosenOne) {
  const auto session = this->session();
  for (int photo = 1; photo <= 2; ++photo) {
    session->open(photo_);
    poll_until_found(*session);
    EXPECT_EQ(looks_, photo);
    EXPECT_EQ(session->settings().material, "leather");
    EXPECT_FALSE(session->hint_was_asked_for());
  }
  session->choices().set_material("bump");
  session->open(photo_);
  EXPECT_FALSE(session->finder().busy());
  EXPECT_EQ(session->settings().material, "bump") << "what was chosen stays for the next photo";
}

TEST_F(SessionLooksForTheMaterial, AndLeavesAloneWhoHasBegunMeanwhile) {
  const auto session = this->session();
  session->open(photo_);
  session->choices().lock("rough", 0.4);
  poll_until_found(*session);
  EXPECT_EQ(session->settings().material, "bump");
  EXPECT_NE(session->hint(), nullptr) << "it says what it saw all the same";
  session->open(photo_);
  EXPECT_EQ(looks_, 1) << "a lock tells of a material, too";
  session->choices().unlock("rough");
  session->open(photo_);
  session->start();
  poll_until_found(*session);
  EXPECT_EQ(looks_, 2);
  EXPECT_EQ(session->settings().material, "bump");
}

TEST_F(SessionLooksForTheMaterial, AnewWhereAnotherPartOfThePhotoIsTakenMeanwhile) {
  const auto session = this->session();
  session->open(photo_);
  session->recrop(session->photo());
  EXPECT_TRUE(session->finder().busy());
  poll_until_found(*session);
  EXPECT_EQ(session->settings().material, "leather");
  session->recrop(session->photo());
  EXPECT_FALSE(session->finder().busy()) << "once it is known, a crop asks for nothing";
}

}  // namespace
}  // namespace patina
