#include "engine/chart/waiting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/chart/spread.h"
#include "engine/error.h"

namespace patina {
namespace {

constexpr double kFirst = 1e-3;  // seconds
constexpr int kADecade = 10;
const std::vector<std::string> kColumns{"setting", "repeat", "seconds", "error", "draws"};

double grid_time(int i) { return kFirst * std::pow(10.0, static_cast<double>(i) / kADecade); }

double error_of(const Eigen::VectorXd& estimate, const GoldStandard& gold) {
  double largest = 0;
  for (std::size_t q = 0; q < gold.continuous().size(); ++q) {
    const GoldQuantity& truth = gold.continuous()[q];
    largest = std::max(largest, std::abs(estimate[static_cast<Eigen::Index>(q)] - truth.mean) / truth.sd);
  }
  return largest;
}

/// The sum of all draws so far, carried from one time to the next.
class RunningMean {
 public:
  explicit RunningMean(const std::vector<TrialChain>& chains) : chains_(chains), used_(chains.size()) {}

  void advance(double seconds) {
    for (std::size_t k = 0; k < chains_.size(); ++k)
      for (; used_[k] < chains_[k].seconds.size() && chains_[k].seconds[used_[k]] <= seconds; ++used_[k]) {
        if (draws_ == 0) sum_ = Eigen::VectorXd::Zero(chains_[k].values[used_[k]].size());
        sum_ += chains_[k].values[used_[k]];
        ++draws_;
      }
  }
  long draws() const { return draws_; }
  Eigen::VectorXd mean() const { return sum_ / static_cast<double>(draws_); }

 private:
  const std::vector<TrialChain>& chains_;
  std::vector<std::size_t> used_;
  Eigen::VectorXd sum_;
  long draws_ = 0;
};

}  // namespace

std::vector<WaitingPoint> waiting_curve(const Trial& trial, const GoldStandard& gold) {
  std::vector<WaitingPoint> curve;
  RunningMean running(trial.chains);
  std::optional<Eigen::VectorXd> match;
  auto next = trial.search.begin();
  int time = 0;
  for (double now = 0; now < trial.seconds;) {
    now = grid_time(time++);
    for (; next != trial.search.end() && next->seconds <= now; ++next) match = next->values;
    running.advance(now);
    if (running.draws() > 0)
      curve.push_back({now, error_of(running.mean(), gold), running.draws()});
    else if (match)
      curve.push_back({now, error_of(*match, gold), 0});
  }
  return curve;
}

TableFile waiting_table(const std::vector<WaitingCurve>& curves) {
  TableFile table;
  table.columns = kColumns;
  for (const WaitingCurve& curve : curves)
    for (const WaitingPoint& point : curve.points)
      table.rows.push_back({curve.setting, std::to_string(curve.repeat), exact_text(point.seconds),
                            exact_text(point.error), std::to_string(point.draws)});
  return table;
}

std::vector<WaitingCurve> waiting_curves(const TableFile& table) {
  if (table.columns != kColumns)
    throw UserError("A waiting.csv with other columns cannot be read: choose another --out.");
  std::vector<WaitingCurve> curves;
  for (const std::vector<std::string>& cells : table.rows) {
    const auto repeat = static_cast<int>(parse_number(cells[1]));
    if (curves.empty() || curves.back().setting != cells[0] || curves.back().repeat != repeat)
      curves.push_back({cells[0], repeat, {}});
    curves.back().points.push_back(
        {parse_number(cells[2]), parse_number(cells[3]), static_cast<long>(parse_number(cells[4]))});
  }
  return curves;
}

std::vector<WaitingPoint> median_curve(const std::vector<WaitingCurve>& curves, const std::string& setting) {
  std::map<double, std::vector<WaitingPoint>> at;
  std::size_t repeats = 0;
  for (const WaitingCurve& curve : curves) {
    if (curve.setting != setting) continue;
    ++repeats;
    for (const WaitingPoint& point : curve.points) at[point.seconds].push_back(point);
  }
  std::vector<WaitingPoint> median;
  for (const auto& [seconds, points] : at) {
    if (2 * points.size() <= repeats) continue;
    std::vector<double> errors, draws;
    for (const WaitingPoint& point : points) {
      errors.push_back(point.error);
      draws.push_back(static_cast<double>(point.draws));
    }
    median.push_back({seconds, spread_of(errors).median, std::lround(spread_of(draws).median)});
  }
  return median;
}

}  // namespace patina
