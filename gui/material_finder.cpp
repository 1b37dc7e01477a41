#include "gui/material_finder.h"

#include <utility>

#include "engine/error.h"
#include "gui/priority.h"

namespace patina {

MaterialFinder::MaterialFinder(Rank rank, std::function<void()> wake)
    : board_(std::make_shared<Board>()),
      loader_(
          [rank = std::move(rank), wake](const Request& request) {
            yield_to_frames();
            const auto tell = [&](double fraction, const std::string& doing) {
              {
                const std::lock_guard lock(request.board->mutex);
                request.board->progress = {fraction, doing};
              }
              if (wake) wake();
            };
            return rank(*request.photo, request.settings, tell, request.stop.get_token());
          },
          wake) {}

void MaterialFinder::start(std::shared_ptr<const Image> photo, const RankSettings& settings) {
  cancel();
  stop_ = std::stop_source();
  board_ = std::make_shared<Board>();
  loader_.start({std::move(photo), settings, stop_, board_});
}

void MaterialFinder::cancel() {
  stop_.request_stop();
  loader_.cancel();
}

MaterialFinder::Progress MaterialFinder::progress() const {
  const std::lock_guard lock(board_->mutex);
  return board_->progress;
}

std::optional<MaterialRanking> MaterialFinder::take() {
  auto outcome = loader_.take();
  if (!outcome) return std::nullopt;
  if (!outcome->loaded) throw UserError(outcome->error);
  return std::move(*outcome->loaded);
}

}  // namespace patina
