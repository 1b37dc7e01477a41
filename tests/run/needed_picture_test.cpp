#include "engine/run/needed_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/convergence.h"
#include "engine/error.h"
#include "engine/run/draw_matrix.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class NeededPictureTest : public RunTest {
 protected:
  static Photo photo() {
    static const Image image = [] {
      const Renderer renderer("bump", 2, Capture{});
      return renderer.render(prior_location(renderer.table()), 64);
    }();
    return photo_of(image);
  }

  /// Of two parameters, the others being held.
  static RunSettings of_two(const std::string& summary, int resolution) {
    RunSettings of_two = settings();
    of_two.errors = "paper";
    const ParameterTable table = Renderer("bump", 2, Capture{}).table();
    const ParameterValues usual = prior_location(table);
    for (std::size_t i = 0; i < table.continuous.size(); ++i)
      if (table.continuous[i].name != "rough" && table.continuous[i].name != "light")
        of_two.fixed[table.continuous[i].name] = usual.continuous[i];
    of_two.summary = summary;
    of_two.resolution = resolution;
    of_two.kernel = "mala";
    of_two.metric = "dense";
    of_two.chains = 2;
    of_two.warmup = 200;
    of_two.draws = 400;
    return of_two;
  }

  std::vector<Draw> sampled(const RunSettings& settings, const std::string& name) const {
    const auto run = start_run(settings, photo(), folder_ / name);
    return draws_to_the_end(*run);
  }

  static Eigen::MatrixXd coordinates(const std::vector<Draw>& draws, const std::string& name) {
    const ParameterTable table = Renderer("bump", 2, Capture{}).table();
    for (std::size_t i = 0; i < table.continuous.size(); ++i)
      if (table.continuous[i].name == name) return coordinates_of(by_chain(draws), table)[i];
    ADD_FAILURE() << name;
    return {};
  }
};

TEST_F(NeededPictureTest, WhatHardlyChangesWithPixelsIsFoundToNeedFew) {
  RunSettings settings = of_two("means", 64);
  settings.fixed["fscale"] = 0;  // a flat surface has no grain that pixels could miss
  const NeededPicture needed = needed_picture(settings, photo().image, sampled(settings, "run"));
  ASSERT_FALSE(needed.tried.empty());
  ASSERT_NE(needed.cheapest(), nullptr)
      << needed.tried.front().resolution << " pixels: " << needed.tried.front().differs_most << " by "
      << needed.tried.front().difference << " +- " << needed.tried.front().error;
  EXPECT_LT(needed.cheapest()->resolution, 64);
  EXPECT_NE(needed.sentence().find("--resolution " + std::to_string(needed.cheapest()->resolution)),
            std::string::npos)
      << needed.sentence();
}

TEST_F(NeededPictureTest, DifferencesAreThoseOfPosteriorsThatAreSampled) {
  const RunSettings whole = of_two("gram", 64), coarse = of_two("gram", 48);
  const std::vector<Draw> draws = sampled(whole, "whole"), others = sampled(coarse, "coarse");
  const NeededPicture needed = needed_picture(whole, photo().image, draws);
  ASSERT_FALSE(needed.tried.empty());
  const CheaperPicture& picture = needed.tried.front();
  ASSERT_EQ(picture.resolution, 48);
  ASSERT_TRUE(picture.differs_most.starts_with("mean of ")) << picture.differs_most;
  const std::string name = picture.differs_most.substr(8);
  const Eigen::MatrixXd x = coordinates(draws, name), y = coordinates(others, name);
  const double sd = standard_deviation(x), sampled = (y.mean() - x.mean()) / sd;
  const double error = std::hypot(mcse_mean(x), mcse_mean(y)) / sd;
  EXPECT_NEAR(picture.difference, sampled, 4 * std::hypot(error, picture.error) + 0.2 * std::abs(sampled))
      << name << ", to first order";
  EXPECT_GT(std::abs(sampled), 4 * error) << "else nothing is tested";
}

TEST_F(NeededPictureTest, RefusesWhatCannotBeCompared) {
  RunSettings settings = of_two("means", 64);
  std::vector<Draw> draws = sampled(settings, "run");
  const auto refusal = [&] {
    try {
      needed_picture(settings, photo().image, draws);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(), "");
  for (Draw& draw : draws) draw.lp += 3;
  EXPECT_NE(refusal().find("the version and the network"), std::string::npos);
  draws.resize(10);
  EXPECT_NE(refusal().find("draw more"), std::string::npos);
  for (const char* measured : {"averaged", "calibrated"}) {
    settings.errors = measured;
    EXPECT_NE(refusal().find("--errors paper"), std::string::npos);
  }
}

}  // namespace
}  // namespace patina
