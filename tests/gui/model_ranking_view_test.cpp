#include "gui/ranking_view.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

RankedMaterial ranked(const char* name, double log_evidence, std::optional<double> error, double probability,
                      double misfit) {
  RankedMaterial material;
  material.material = name;
  material.log_evidence = log_evidence;
  material.error = error;
  material.probability = probability;
  material.misfit = misfit;
  return material;
}

TEST(RankingView, NamesNoProbabilityCloserThanAComparisonCanTell) {
  const auto words = [](double probability) {
    const RankedMaterial material = ranked("a", 0, 0.1, probability, 1);
    return standing(material, material).words;
  };
  EXPECT_EQ(words(0.9999999), "over 99 %");
  EXPECT_EQ(words(0.4213), "42 %");
  EXPECT_EQ(words(1e-40), "under 1 %");
  const RankedMaterial glanced = ranked("a", 0, {}, 0.4213, 1);
  EXPECT_EQ(standing(glanced, glanced).words, "42 % at first sight") << "a glance has no error";
}

TEST(RankingView, SaysAfterASearchHowMuchFurtherOffTheOthersAre) {
  RankedMaterial first = ranked("a", -20, {}, 0.001, 1), other = ranked("b", -10, {}, 0.999, 1);
  first.distance = 0.4;
  other.distance = 0.5;
  EXPECT_EQ(standing(first, first).words, "nearest");
  EXPECT_EQ(standing(first, first).share, 1);
  EXPECT_EQ(standing(other, first).words, "25 % further off");
  EXPECT_DOUBLE_EQ(standing(other, first).share, 0.8);
  other.distance = 0.3;  // a simpler one that is as near, within the error, comes before it
  EXPECT_EQ(standing(other, first).words, "nearest");
  EXPECT_EQ(standing(other, first).share, 1);
}

TEST(RankingView, SaysHowTheBestMatchFits) {
  EXPECT_EQ(fit_text(ranked("a", 0, 0.1, 1, 0.9)), "fits (0.9)");
  EXPECT_EQ(fit_text(ranked("a", 0, 0.1, 1, 1.7)), "fits roughly (1.7)");
  EXPECT_EQ(fit_text(ranked("a", 0, 0.1, 1, 6.25)), "does not fit (6.2)");
  EXPECT_EQ(fit_text(RankedMaterial{}), "");
}

TEST(RankingView, AdvisesToTryBothWhereTheComparisonCannotTellThemApart) {
  MaterialRanking ranking;
  ranking.materials = {ranked("leather", -10, 1.0, 0.7, 1), ranked("plaster", -11, 1.0, 0.3, 1)};
  const std::string close = uncertainty_text(ranking);
  for (const char* part : {"hint", "try leather and plaster"})
    EXPECT_NE(close.find(part), std::string::npos) << part << " in: " << close;
  ranking.materials[1].log_evidence = -40;
  const std::string far = uncertainty_text(ranking);
  for (const char* part : {"hint", "Look at what leather renders"})
    EXPECT_NE(far.find(part), std::string::npos) << part << " in: " << far;
}

}  // namespace
}  // namespace patina
