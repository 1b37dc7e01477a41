#include "engine/run/stop_monitor.h"

#include <algorithm>
#include <utility>

#include "engine/run/run_files.h"

namespace patina {
namespace {

constexpr std::size_t kFewestNewDraws = 100;

}  // namespace

StopMonitor::StopMonitor(StopRules rules, ParameterTable table, std::filesystem::path directory, int chains)
    : rules_(rules),
      table_(std::move(table)),
      directory_(std::move(directory)),
      chains_(static_cast<std::size_t>(chains)) {}

void StopMonitor::look(bool in_any_case) {
  for (int k = 0; k < static_cast<int>(chains_.size()); ++k) read(k);
  const bool due = draws_.size() >= judged_ + std::max(kFewestNewDraws, judged_ / 10);
  if (!due && !in_any_case) return;
  judged_ = draws_.size();
  evidence_ = stop_evidence(summarize_draws(table_, draws_));
}

void StopMonitor::read(int chain) {
  const std::filesystem::path path = chain_file(directory_, chain);
  ChainFile& file = chains_[static_cast<std::size_t>(chain)];
  std::error_code ignored;
  if (!file.reader) {
    if (!std::filesystem::exists(path, ignored)) return;
    file.reader.emplace(path);
  }
  for (const ChainCsvReader::Row& row : file.reader->read_new()) {
    const std::int64_t iteration = file.rows++;
    if (!row.warmup) draws_.push_back(to_draw(row, table_, chain, iteration));
  }
}

}  // namespace patina
