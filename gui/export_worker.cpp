#include "gui/export_worker.h"

#include <cassert>
#include <chrono>
#include <exception>
#include <utility>

namespace patina {
namespace {

struct Cancelled {};

}  // namespace

void ExportWorker::start(std::vector<ExportJob> jobs, const std::filesystem::path& folder) {
  assert(!busy());
  done_ = 0;
  stop_ = std::stop_source();
  pending_ = std::async(std::launch::async, [this, jobs = std::move(jobs), folder, stop = stop_.get_token()] {
    Outcome outcome = write(jobs, folder, stop);
    if (wake_) wake_();
    return outcome;
  });
}

ExportWorker::Outcome ExportWorker::write(const std::vector<ExportJob>& jobs,
                                          const std::filesystem::path& folder, const std::stop_token& stop) {
  double jobs_before = 0;
  const auto progress = [&](double done) {
    if (stop.stop_requested()) throw Cancelled();
    done_ = (jobs_before + done) / static_cast<double>(jobs.size());
    if (wake_) wake_();
  };
  try {
    for (const ExportJob& job : jobs) {
      export_draw(job.request, job.subfolder.empty() ? folder : folder / job.subfolder, progress);
      ++jobs_before;
    }
  } catch (const Cancelled&) {
    return {folder, true, {}};
  } catch (const std::exception& error) {
    return {folder, false, error.what()};
  }
  return {folder, false, {}};
}

std::optional<ExportWorker::Outcome> ExportWorker::take() {
  if (!busy() || pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return pending_.get();
}

}  // namespace patina
