#include "engine/run/warmup_meeting.h"

#include <utility>

#include "engine/run/run_control.h"
#include "engine/sampling/warmup.h"

namespace patina {

std::shared_ptr<const Metric> WarmupMeeting::meet(int chain, Eigen::MatrixXd positions,
                                                  const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  positions_[static_cast<std::size_t>(chain)] = std::move(positions);
  const int meeting = meetings_;
  if (++arrived_ == static_cast<int>(positions_.size())) {
    metric_ = std::make_shared<const Metric>(pooled_covariance(positions_));
    arrived_ = 0;
    ++meetings_;
    complete_.notify_all();
  } else if (!complete_.wait(lock, stop, [&] { return meetings_ > meeting; })) {
    throw RunStopped();
  }
  // Nobody can start the next meeting's metric before all have left this one with theirs.
  return metric_;
}

}  // namespace patina
