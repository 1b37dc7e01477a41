#include "engine/run/run_files.h"

#include <cassert>
#include <cmath>

#include "engine/error.h"
#include "engine/sampling/chain_state.h"

namespace patina {

std::filesystem::path manifest_file(const std::filesystem::path& directory) { return directory / "run.json"; }
std::filesystem::path photo_file(const std::filesystem::path& directory) { return directory / "photo.png"; }
std::filesystem::path lock_file(const std::filesystem::path& directory) { return directory / "writer.lock"; }

std::filesystem::path chain_file(const std::filesystem::path& directory, int chain) {
  return directory / ("chain-" + std::to_string(chain + 1) + ".csv");
}

std::vector<std::string> column_names(const ParameterTable& table) {
  std::vector<std::string> names;
  for (const Parameter& parameter : table.continuous) names.push_back(parameter.name);
  for (const DiscreteParameter& parameter : table.discrete) names.push_back(parameter.name);
  return names;
}

ChainCsvRow to_row(const Draw& draw, const TransitionInfo& info) {
  ChainCsvRow row;
  row.lp = draw.lp;
  row.accept_stat = draw.accept_stat;
  row.stepsize = draw.step_size;
  row.treedepth = info.tree_depth;
  row.n_leapfrog = info.evaluations;
  row.divergent = draw.divergent;
  row.energy = draw.energy;
  row.values = draw.values.continuous;
  row.values.insert(row.values.end(), draw.values.discrete.begin(), draw.values.discrete.end());
  return row;
}

Draw to_draw(const ChainCsvReader::Row& row, const ParameterTable& table, int chain, std::int64_t iteration) {
  const std::size_t continuous = table.continuous.size();
  assert(row.row.values.size() == continuous + table.discrete.size());
  Draw draw;
  draw.chain = chain;
  draw.iteration = iteration;
  draw.warmup = row.warmup;
  draw.lp = row.row.lp;
  draw.energy = row.row.energy;
  draw.accept_stat = row.row.accept_stat;
  draw.step_size = row.row.stepsize;
  draw.divergent = row.row.divergent;
  draw.values.continuous.assign(row.row.values.begin(),
                                row.row.values.begin() + static_cast<std::ptrdiff_t>(continuous));
  for (std::size_t i = 0; i < table.discrete.size(); ++i) {
    const double level = row.row.values[continuous + i];
    if (!(level >= 0 && level < static_cast<double>(table.discrete[i].levels.size()) &&
          level == std::floor(level)))
      throw UserError("The chain file " + chain_file("", chain).string() + " holds a " +
                      table.discrete[i].name +
                      " that does not exist: restore it from a copy or start a new run.");
    draw.values.discrete.push_back(static_cast<int>(level));
  }
  return draw;
}

}  // namespace patina
