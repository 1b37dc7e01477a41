#include "gui/export_worker.h"

#include <cassert>
#include <chrono>
#include <exception>

namespace patina {

void ExportWorker::start(const ExportRequest& request, const std::filesystem::path& folder) {
  assert(!busy());
  pending_ = std::async(std::launch::async, [request, folder] {
    Outcome outcome{folder, {}};
    try {
      export_draw(request, folder);
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
