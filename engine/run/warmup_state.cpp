#include "engine/run/warmup_state.h"

#include <vector>

#include "engine/run/state_file.h"
#include "engine/run/state_fits.h"
#include "engine/sampling/serialise.h"

namespace patina {
namespace {

struct Agreement {
  int window = 0;
  LadderSettings settings;
  void serialise(Archive& archive) { archive(window, settings); }
};

}  // namespace

void write_warmup(const std::filesystem::path& directory, const std::string& run_key, WarmupRecord record) {
  std::vector<Agreement> agreements;
  for (const auto& [window, settings] : record) agreements.push_back({window, settings});
  Archive archive;
  archive(agreements);
  write_state(warmup_state_file(directory), run_key, archive.take_bytes());
}

WarmupRecord read_warmup(const std::filesystem::path& directory, const std::string& run_key,
                         const LogDensity& target, int rungs) {
  WarmupRecord record;
  read_state(warmup_state_file(directory), run_key, [&](Archive& archive) {
    std::vector<Agreement> agreements;
    archive(agreements);
    for (const Agreement& agreement : agreements) {
      if (!fits(agreement.settings, target, rungs)) throw ArchiveError("it is of another posterior");
      record[agreement.window] = agreement.settings;
    }
  });
  return record;
}

}  // namespace patina
