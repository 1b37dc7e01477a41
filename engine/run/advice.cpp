#include "engine/run/advice.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "engine/diagnostics/conditioning.h"
#include "engine/diagnostics/convergence.h"
#include "engine/diagnostics/density_at.h"
#include "engine/format.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/draw_matrix.h"
#include "engine/run/verdict.h"

namespace patina {
namespace {

constexpr double kRedundant = 0.9;        // correlation
constexpr double kFewestEffective = 100;  // draws of a parameter about which anything is said

double normal_cdf(double u) { return 0.5 * std::erfc(-u * M_SQRT1_2); }

/// One column a parameter, chains under each other.
Eigen::MatrixXd pooled(const std::vector<Eigen::MatrixXd>& coordinates) {
  Eigen::MatrixXd draws(coordinates.front().size(), std::ssize(coordinates));
  for (Eigen::Index i = 0; i < draws.cols(); ++i)
    draws.col(i) = coordinates[static_cast<std::size_t>(i)].reshaped();
  return draws;
}

class Adviser {
 public:
  Adviser(const ParameterTable& table, const std::vector<Draw>& draws,
          const std::map<std::string, double>& off)
      : table_(table), off_(off), chains_(by_chain(draws)), coordinates_(coordinates_of(chains_, table)) {}

  std::vector<ParameterAdvice> advise() {
    if (coordinates_.empty() || coordinates_.front().size() == 0) return {};
    pooled_ = pooled(coordinates_);
    for (std::size_t i = 0; i < coordinates_.size(); ++i)
      if (coordinates_[i].maxCoeff() > coordinates_[i].minCoeff() && effective(i) >= kFewestEffective) add(i);
    choose_frozen();
    for (ParameterAdvice& advice : advice_) advice.sentence = sentence_of(advice);
    return std::move(advice_);
  }

 private:
  void add(std::size_t i) {
    const Parameter& parameter = table_.continuous[i];
    ParameterAdvice advice;
    advice.name = parameter.name;
    const Eigen::MatrixXd values =
        matrix_of(chains_, [&](const Draw& draw) { return draw.values.continuous[i]; });
    advice.sd_over_prior_sd = standard_deviation(values) / truncated_sd(parameter.prior);
    advice.identified = advice.sd_over_prior_sd <= kNotIdentified;
    find_partner(i, advice);
    if (const auto off = off_.find(parameter.name); off != off_.end()) {
      const double u = PriorTransform(parameter.prior).coordinate(off->second);
      const auto [ratio, error] = density_at(coordinates_[i].unaryExpr(&normal_cdf), normal_cdf(u));
      advice.off = {off->second, ratio, error};
    }
    advice_.push_back(advice);
    places_.push_back(static_cast<Eigen::Index>(i));
  }

  void find_partner(std::size_t i, ParameterAdvice& advice) const {
    const auto n = static_cast<double>(pooled_.rows());
    const Eigen::VectorXd own =
        pooled_.col(static_cast<Eigen::Index>(i)).array() - pooled_.col(static_cast<Eigen::Index>(i)).mean();
    const double independent = std::min(n, effective(i));
    for (Eigen::Index j = 0; j < pooled_.cols(); ++j) {
      if (j == static_cast<Eigen::Index>(i)) continue;
      const Eigen::VectorXd other = pooled_.col(j).array() - pooled_.col(j).mean();
      const double r = own.dot(other) / (own.norm() * other.norm());
      const double error = (1 - r * r) / std::sqrt(independent);
      if (!(std::abs(r) - 2 * error > std::max(kRedundant, std::abs(advice.correlation)))) continue;
      advice.redundant_with = table_.continuous[static_cast<std::size_t>(j)].name;
      advice.correlation = r;
    }
  }

  double effective(std::size_t i) const { return mean_ess(coordinates_[i]); }

  /// Those not needed first, then those not identified, each as long as the others stay what they are.
  void choose_frozen() {
    for (const bool unneeded : {true, false})
      for (std::size_t k = 0; k < advice_.size(); ++k) {
        ParameterAdvice& advice = advice_[k];
        const bool off = advice.off && advice.off->ratio - 2 * advice.off->error > kUnneeded;
        if (advice.freeze_at || (unneeded ? !off : off || advice.identified)) continue;
        const double u = off ? transform(k).coordinate(advice.off->value) : pooled_.col(places_[k]).mean();
        held_.push_back(places_[k]);
        held_at_.push_back(u);
        if (leaves_the_others())
          advice.freeze_at = off ? advice.off->value : transform(k).value(u);
        else
          held_.pop_back(), held_at_.pop_back();
      }
  }

  PriorTransform transform(std::size_t k) const {
    return PriorTransform(table_.continuous[static_cast<std::size_t>(places_[k])].prior);
  }

  bool leaves_the_others() const {
    const auto [shift, narrowing] =
        condition(pooled_, held_, Eigen::Map<const Eigen::VectorXd>(held_at_.data(), std::ssize(held_at_)));
    return shift.cwiseAbs().maxCoeff() <= kMostShift && narrowing.minCoeff() >= 1 - kMostNarrowing;
  }

  static std::string sentence_of(const ParameterAdvice& a) {
    const std::string hold = a.freeze_at ? format(" It can be held at %.3g.", *a.freeze_at)
                                         : " Held, it would change what the photo says of others: leave it.";
    if (a.off && a.off->ratio - 2 * a.off->error > kUnneeded)
      return format(
                 "This photo does not need %s: without it (%.3g) is %.1f +- %.1f times likelier than before.",
                 a.name.c_str(), a.off->value, a.off->ratio, a.off->error) +
             hold;
    if (!a.identified)
      return format("This photo does not pin down %s: %.0f %% of the prior's spread is left.", a.name.c_str(),
                    100 * a.sd_over_prior_sd) +
             hold;
    if (!a.redundant_with.empty())
      return format("This photo tells little more than a combination of %s and %s (correlation %.2f).",
                    a.name.c_str(), a.redundant_with.c_str(), a.correlation);
    return {};
  }

  const ParameterTable& table_;
  const std::map<std::string, double>& off_;
  DrawsByChain chains_;
  std::vector<Eigen::MatrixXd> coordinates_;
  Eigen::MatrixXd pooled_;
  std::vector<ParameterAdvice> advice_;
  std::vector<Eigen::Index> places_;  ///< of the advice in the table
  std::vector<Eigen::Index> held_;
  std::vector<double> held_at_;
};

}  // namespace

std::vector<ParameterAdvice> advise(const ParameterTable& table, const std::vector<Draw>& draws,
                                    const std::map<std::string, double>& off) {
  return Adviser(table, draws, off).advise();
}

std::map<std::string, double> frozen_by(const std::vector<ParameterAdvice>& advice) {
  std::map<std::string, double> frozen;
  for (const ParameterAdvice& a : advice)
    if (a.freeze_at) frozen[a.name] = *a.freeze_at;
  return frozen;
}

}  // namespace patina
