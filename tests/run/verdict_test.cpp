#include "engine/run/verdict.h"

#include <gtest/gtest.h>

#include <limits>

namespace patina {
namespace {

QuantitySummary quantity(const std::string& name, double rhat, double ess, double sd_over_prior_sd) {
  QuantitySummary q;
  q.name = name;
  q.mean = 0.5;
  q.rhat = rhat;
  q.bulk_ess = ess;
  q.tail_ess = ess + 100;
  q.sd_over_prior_sd = sd_over_prior_sd;
  q.chain_means = {{0, 0.55}, {1, 0.45}, {2, 0.5}, {3, 0.9}};
  return q;
}

TEST(Verdict, SaysWhatIsFurthestFromGoodAndWhichChainStandsApart) {
  RunSummary summary;
  summary.quantities = {quantity("fine", 1.001, 900, 0.2), quantity("slow", 1.03, 150, 0.3),
                        quantity("slower", 1.2, 300, 0.3), quantity("prior", 1.09, 5, 0.95)};
  summary.directions = {{"fine + slow", {}, 0.5, 900, 900, 1.005}, {"slow - slower", {}, 0.3, 50, 50, 1.3}};
  EXPECT_EQ(furthest_from_good(summary)->name, "slower");
  const std::string text = verdict(summary);
  for (const char* part : {"do not agree", "slower", "1.200", "chain 4", "0.9", "slow - slower", "1.300"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(Verdict, IsGoodOnlyWhenEveryIdentifiedParameterIs) {
  RunSummary summary;
  summary.quantities = {quantity("a", 1.0099, 401, 0.2), quantity("not pinned down", 1.09, 5, 0.95)};
  EXPECT_NE(verdict(summary).find("The chains agree"), std::string::npos) << verdict(summary);
  summary.quantities.push_back(quantity("b", 1.005, 399, 0.2));
  EXPECT_EQ(verdict(summary).find("The chains agree"), std::string::npos) << "too few effective draws";
  summary.quantities.back() = quantity("b", 1.011, 900, 0.2);
  EXPECT_EQ(verdict(summary).find("The chains agree"), std::string::npos) << "R-hat";
}

TEST(Verdict, ChainsThatSitApartAreNotTakenForAParameterThatThePhotoLeavesOpen) {
  RunSummary summary;
  summary.quantities = {quantity("a", 1.0099, 401, 0.2), quantity("shift", 2, 5, 1.3)};
  EXPECT_EQ(furthest_from_good(summary)->name, "shift");
  EXPECT_FALSE(chains_agree(summary));
}

TEST(Verdict, OfNothingThatCanBeJudgedSaysSo) {
  RunSummary summary;
  EXPECT_NE(verdict(summary).find("too few"), std::string::npos);
  summary.quantities = {quantity("held", std::numeric_limits<double>::quiet_NaN(), 100, 0)};
  EXPECT_EQ(furthest_from_good(summary), nullptr);
}

}  // namespace
}  // namespace patina
