#include "gui/export_worker.h"

#include <cassert>
#include <chrono>
#include <exception>
#include <utility>

namespace patina {

void ExportWorker::start(std::vector<ExportJob> jobs, const std::filesystem::path& folder) {
  assert(!busy());
  pending_ = std::async(std::launch::async, [jobs = std::move(jobs), folder] {
    Outcome outcome{folder, {}};
    try {
      for (const ExportJob& job : jobs) {
        export_draw(job.request, job.subfolder.empty() ? folder : folder / job.subfolder);
      }
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    return outcome;
  });
}

std::optional<ExportWorker::Outcome> ExportWorker::take() {
  if (!busy() || pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return pending_.get();
}

}  // namespace patina
