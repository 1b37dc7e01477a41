#include "engine/run/run_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run_files.h"
#include "engine/run/run_lock.h"
#include "engine/run/run_photo.h"

namespace patina {
namespace {

constexpr std::chrono::milliseconds kLookInterval(200);

/// Its values are handed to the material of this program, which must be the one that they were drawn for, and
/// which tells of its parameters what a manifest does not.
void recognise_material(Manifest& manifest) {
  const ParameterTable known = material_table(manifest.table.material);
  bool same = column_names(known) == column_names(manifest.table);
  for (std::size_t i = 0; same && i < known.discrete.size(); ++i)
    same = known.discrete[i].levels.size() == manifest.table.discrete[i].levels.size();
  if (!same)
    throw UserError("The run was made with another version of the material " + known.material + " (by " +
                    manifest.program + "): open it with that version.");
  for (std::size_t i = 0; i < known.continuous.size(); ++i) {
    manifest.table.continuous[i].jagged = known.continuous[i].jagged;
    manifest.table.continuous[i].place = known.continuous[i].place;
  }
}

}  // namespace

RunReader::RunReader(const std::filesystem::path& directory, std::size_t portion)
    : directory_(directory),
      portion_(portion),
      manifest_(read_manifest(directory)),
      photo_(read_run_photo(directory)),
      chains_(static_cast<std::size_t>(manifest_.settings.chains)),
      writer_lives_(is_locked(lock_file(directory))) {
  recognise_material(manifest_);
}

std::vector<Draw> RunReader::take_draws() {
  const auto now = RateMeter::Clock::now();
  if (!more_ && last_look_ && now < *last_look_ + kLookInterval) return {};
  more_ = false;
  // In this order, so that a writer that ended in between left nothing unread.
  writer_lives_ = is_locked(lock_file(directory_));  // also of a run that ended: it may be taken up again
  const bool ended = has_ended(manifest_.phase) && !writer_lives_;
  if (!ended) read_again();
  std::vector<Draw> draws;
  for (int k = 0; k < manifest_.settings.chains; ++k) read_chain(k, draws);
  if (caught_up_ && !draws.empty()) {
    // Draws after the end are of a run that was taken up, and ended, again between two looks.
    if (ended) read_again();
    draw_rate_.count(static_cast<std::int64_t>(draws.size()), now);
  }
  caught_up_ |= !more_;
  last_look_ = now;
  return draws;
}

void RunReader::read_again() {
  Manifest now = read_manifest(directory_);
  const bool same = now.settings.chains == manifest_.settings.chains &&
                    now.photo_sha256 == manifest_.photo_sha256 &&
                    column_names(now.table) == column_names(manifest_.table);
  if (!same) throw UserError("Another run has been put in " + directory_.string() + ": open it again.");
  recognise_material(now);
  manifest_ = std::move(now);
}

void RunReader::read_chain(int chain, std::vector<Draw>& draws) {
  ChainFile& file = chains_[static_cast<std::size_t>(chain)];
  if (!file.reader) {
    std::error_code ignored;
    if (!std::filesystem::exists(chain_file(directory_, chain), ignored)) return;
    file.reader.emplace(chain_file(directory_, chain));
  }
  const std::size_t share = std::max<std::size_t>(1, portion_ / chains_.size());
  const auto rows = file.reader->read_new(share);
  more_ |= rows.size() >= share;
  if (file.reader->has_header() && file.reader->header().names != column_names(table()))
    throw UserError(chain_file(directory_, chain).string() +
                    " has other parameters than run.json: restore both from a copy.");
  for (const ChainCsvReader::Row& row : rows) {
    draws.push_back(to_draw(row, table(), chain, file.rows++));
    take_in(draws.back());
  }
}

void RunReader::take_in(const Draw& draw) {
  chains_[static_cast<std::size_t>(draw.chain)].tally.add(draw);
  if (!best_draw_ || draw.lp > best_draw_->lp) best_draw_ = MapPoint{draw.values, draw.lp};
}

RunPhase RunReader::phase() const {
  if (has_ended(manifest_.phase)) return manifest_.phase;
  if (!writer_lives_) return RunPhase::stopped;
  if (!manifest_.map) return RunPhase::searching;
  return draws_after_warmup() > 0 ? RunPhase::sampling : RunPhase::warming_up;
}

std::string RunReader::message(RunPhase phase) const {
  switch (phase) {
    case RunPhase::searching:
      return "another program is looking for a good match";
    case RunPhase::warming_up:
      return "another program is warming up its chains";
    case RunPhase::sampling:
      return "another program is drawing samples";
    default:
      if (!has_ended(manifest_.phase))
        return "the program that made this run ended early: " + std::to_string(draws_after_warmup()) +
               " draws were kept";
      return manifest_.reason;
  }
}

std::int64_t RunReader::draws_after_warmup() const {
  std::int64_t draws = 0;
  for (const ChainFile& chain : chains_) draws += chain.tally.draws_after_warmup();
  return draws;
}

double RunReader::read_fraction() const {
  if (caught_up_) return 1;
  double read = 0, there = 0;
  for (std::size_t k = 0; k < chains_.size(); ++k) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(chain_file(directory_, static_cast<int>(k)), missing);
    if (missing || !chains_[k].reader) continue;
    read += static_cast<double>(chains_[k].reader->bytes_read());
    there += static_cast<double>(size);
  }
  return there > 0 ? std::min(1.0, read / there) : 0;
}

RunStatus RunReader::status() const {
  RunStatus status;
  status.read_fraction = read_fraction();
  status.phase = phase();
  status.message = message(status.phase);
  status.search_fraction = manifest_.map ? 1 : 0;
  status.alarms = manifest_.alarms;
  status.errors = manifest_.errors;
  status.warmup = manifest_.warmup;
  if (const auto& best = manifest_.map ? manifest_.map : manifest_.so_far ? manifest_.so_far : best_draw_) {
    status.best = best->values;
    status.best_lp = best->lp;
  }
  for (const ChainFile& chain : chains_) status.chains.push_back(chain.tally.status());
  if (!has_ended(status.phase)) status.draws_per_second = draw_rate_.per_second(RateMeter::Clock::now());
  return status;
}

}  // namespace patina
