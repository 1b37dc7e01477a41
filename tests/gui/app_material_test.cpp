#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppMaterial : public AppTest {
 protected:
  std::size_t row(const char* name) const { return *table_.find_continuous(name); }
  const ParameterTableView::RowPlace& place(const char* name) const {
    return app_.material().table().places()[row(name)];
  }
  const RunChoices& choices() const { return app_.session().choices(); }
};

TEST_F(AppMaterial, AClickOnALockHoldsTheParameterAtTheShownValue) {
  start_run_of({draw(0.25, 0.5, -3), draw(0.55, 0.8, -1)});
  app_.session().model().select(0);
  frames(2);
  click(place("rough").lock);
  ASSERT_TRUE(choices().locked("rough"));
  EXPECT_EQ(choices().settings().fixed.at("rough"), 0.25);
  EXPECT_TRUE(app_.session().choices_wait()) << "the run that is open goes on without the lock";
  EXPECT_TRUE(app_.session().run().settings().fixed.empty());
  press('Z', ImGuiKeyModFlags_Ctrl);
  EXPECT_FALSE(choices().locked("rough"));
  press('Z', ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift);
  EXPECT_TRUE(choices().locked("rough"));
  click(place("rough").lock);
  EXPECT_FALSE(choices().locked("rough"));
}

TEST_F(AppMaterial, TheNextRunIsMadeWithLocksAndPriors) {
  start_run_of({draw(0.25, 0.5, -3)});
  click(place("rough").lock);
  app_.session().choices().set_prior("light", {1000, 50, 0, 2000}, true);
  app_.session().start();
  EXPECT_EQ(app_.session().run().settings().fixed.at("rough"), 0.25);
  EXPECT_EQ(app_.session().run().settings().priors.at("light").mean, 1000);
  EXPECT_FALSE(app_.session().choices_wait());
}

TEST_F(AppMaterial, DraggingInThePriorsWindowIsOneStepBack) {
  app_.load(photo_);
  frames(2);
  const ImVec2 at = place("rough").curve;
  click(at);
  const TruncatedNormal before = choices().table().continuous[row("rough")].prior;
  const Rect fields = app_.material().table().editor().fields();
  const ImVec2 field{fields.position.x + 0.7f * fields.size.x, fields.position.y + 0.12f * fields.size.y};
  window_->drag(field.x, field.y, field.x + 60, field.y);
  answer_input();
  const TruncatedNormal after = choices().table().continuous[row("rough")].prior;
  EXPECT_GT(after.mean, before.mean);
  EXPECT_EQ(after.sd, before.sd);
  press(ImGui::GetKeyIndex(ImGuiKey_Escape), ImGuiKeyModFlags_None);
  app_.session().choices().undo();
  EXPECT_EQ(choices().table().continuous[row("rough")].prior, before);
  EXPECT_FALSE(choices().can_undo());
}

TEST_F(AppMaterial, TheBarsFollowTheDrawsInAMomentAndAreWholeAtTheEnd) {
  start_run_of({draw(0.25, 0.5, -3)});
  frames(2);
  const ImVec2 at = place("rough").curve;
  const auto bars = [&] {
    const Image shot = window_->screenshot();
    std::vector<float> greens;
    for (int x = static_cast<int>(at.x) - 25; x < static_cast<int>(at.x) + 25; ++x)
      for (int y = static_cast<int>(at.y) - 5; y < static_cast<int>(at.y) + 5; ++y)
        greens.push_back(shot.at(y, x, 1));
    return greens;
  };
  const auto feed = [&](double value) { run_->feed(std::vector<Draw>(500, draw(value, 0.5, -3))); };
  const auto first = bars();
  feed(0.5);
  EXPECT_TRUE(frames_until([&] { return bars() != first; }));
  const auto live = bars();
  feed(0.35);
  run_->status.phase = RunPhase::finished;
  frames(2);
  EXPECT_NE(bars(), live);
}

TEST_F(AppMaterial, TheSearchForTheMaterialEndsInAListToChooseFrom) {
  MaterialRanking ranking;
  for (const char* name : {"leather", "plaster", "bump"}) {
    RankedMaterial material;
    material.material = name;
    material.probability = 0.4;
    ranking.materials.push_back(material);
  }
  ranking.sentence = "leather or plaster.";
  ranking_ = ranking;
  app_.load(photo_);
  ASSERT_TRUE(frames_until([&] { return app_.session().hint() != nullptr; }));
  EXPECT_EQ(choices().settings().material, "leather");
  frames(4);
  EXPECT_FALSE(app_.material().hint().place_of("plaster")) << "nobody asked for a list";
  for (const Action& action : app_.actions())
    if (action.name == "Material: find out which it is") action.run();
  ASSERT_TRUE(frames_until([&] { return app_.session().hint_was_asked_for(); }));
  frames(4);
  const auto place = app_.material().hint().place_of("plaster");
  ASSERT_TRUE(place) << "the list opens by itself: it was waited for";
  click(*place);
  EXPECT_EQ(choices().settings().material, "plaster");
  press('Z', ImGuiKeyModFlags_Ctrl);
  press('Z', ImGuiKeyModFlags_Ctrl);
  EXPECT_EQ(choices().settings().material, "bump") << "each choice is one step back";
}

TEST_F(AppMaterial, AnotherMaterialShowsItsParametersAndTheRunsDrawsStay) {
  start_run_of({draw(0.25, 0.5, -3)});
  app_.session().choices().set_material("leather");
  frames(3);
  const ParameterTable& leather = choices().table();
  EXPECT_EQ(app_.material().table().places().size(), leather.continuous.size() + leather.discrete.size());
  EXPECT_EQ(app_.session().model().draws().size(), 1u);
}

}  // namespace
}  // namespace patina::testing
