#include "gui/preview_feed.h"

#include <utility>

namespace patina {
namespace {

constexpr auto kUnhurried = std::chrono::milliseconds(700);

}  // namespace

void PreviewFeed::want(const Session& session, const ShownDraw& shown, int resolution, bool tile) {
  PreviewRequest request = preview_request(session, shown, resolution, tile);
  if (asked_ && same_picture(*asked_, request)) return;
  const bool same_run = asked_ && asked_->material == request.material &&
                        asked_->resolution == request.resolution && asked_->tile == request.tile;
  const bool hurry = shown.kind == ShownDraw::Kind::selected || !same_run;
  if (!hurry && (waiting() || Clock::now() - asked_at_ < kUnhurried)) return;
  asked_ticket_ = worker_.request(request);
  asked_ = std::move(request);
  asked_at_ = Clock::now();
}

std::optional<Preview> PreviewFeed::take() {
  auto preview = worker_.take();
  if (preview) taken_ticket_ = preview->ticket;
  return preview;
}

}  // namespace patina
