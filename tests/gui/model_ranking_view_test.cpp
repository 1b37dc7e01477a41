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
  EXPECT_EQ(likelihood_text(ranked("a", 0, 0.1, 0.9999999, 1)), "over 99 %");
  EXPECT_EQ(likelihood_text(ranked("a", 0, 0.1, 0.4213, 1)), "42 %");
  EXPECT_EQ(likelihood_text(ranked("a", 0, 0.1, 1e-40, 1)), "under 1 %");
  EXPECT_EQ(likelihood_text(ranked("a", 0, {}, 0.4213, 1)), "42 % at first sight") << "a first cut has no error";
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
  for (const char* part : {"hint", "factor of 4"})  // e^sqrt(2)
    EXPECT_NE(far.find(part), std::string::npos) << part << " in: " << far;
}

}  // namespace
}  // namespace patina
