#include "engine/stress/judge.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagnostics/convergence.h"
#include "engine/run/verdict.h"

namespace patina {
namespace {

/// Iterations x chains; chains are of one length.
Eigen::MatrixXd matrix_of(const Known& known, const std::vector<Draw>& draws) {
  Eigen::Index chains = 0;
  for (const Draw& draw : draws) chains = std::max<Eigen::Index>(chains, draw.chain + 1);
  Eigen::MatrixXd values(std::ssize(draws) / std::max<Eigen::Index>(chains, 1), chains);
  std::vector<Eigen::Index> next(static_cast<std::size_t>(chains), 0);
  for (const Draw& draw : draws)
    if (Eigen::Index& row = next[static_cast<std::size_t>(draw.chain)]; row < values.rows())
      values(row++, draw.chain) = known.of(draw.values);
  return values;
}

double spread(const Eigen::MatrixXd& values) {
  return std::sqrt((values.array() - values.mean()).square().sum() / static_cast<double>(values.size() - 1));
}

Error error_of(const Known& known, const Eigen::MatrixXd& values) {
  if (values.size() < 2) return {known.name, std::numeric_limits<double>::infinity(), 0};
  const double sd = spread(values);
  const double of_mean = std::abs(values.mean() - known.mean) / known.sd;
  const double of_sd = std::abs(std::log(sd / known.sd));
  // !(<) also takes what is not a number
  if (!(of_mean < of_sd)) return {known.name, of_mean, mcse_mean(values) / known.sd};
  return {"sd of " + known.name, of_sd, mcse_sd(values) / sd};
}

}  // namespace

std::string word(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::alarmed:
      return "alarmed";
    case Outcome::refused:
      return "refused";
    case Outcome::silent:
      return "SILENT";
  }
  return {};
}

std::vector<std::string> warnings(const Evidence& evidence) {
  std::vector<std::string> names;
  if (!evidence.is_short && !chains_agree(evidence.summary)) names.push_back("unconverged");
  for (const Alarm& alarm : evidence.alarms)
    if (std::ranges::find(names, alarm.name) == names.end()) names.push_back(alarm.name);
  return names;
}

Outcome outcome(const Evidence& evidence) {
  if (!evidence.refusal.empty()) return Outcome::refused;
  if (evidence.error.size <= evidence.limit) return Outcome::right;
  return warnings(evidence).empty() ? Outcome::silent : Outcome::alarmed;
}

Error worst_error(const std::vector<Known>& known, const std::vector<Draw>& draws) {
  Error worst{"", -1, 0};
  for (const Known& quantity : known)
    if (const Error error = error_of(quantity, matrix_of(quantity, draws)); !(error.size <= worst.size))
      worst = error;
  return worst;
}

}  // namespace patina
