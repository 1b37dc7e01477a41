#include "gui/preview/preview_feed.h"

#include <utility>

namespace patina {
namespace {

constexpr auto kUnhurried = std::chrono::milliseconds(700);

}  // namespace

bool PreviewFeed::is_of(const std::optional<Asked>& asked, const PreviewRequest& request) {
  return asked && same_picture(asked->request, request);
}

void PreviewFeed::want(const Session& session, const ShownDraw& shown, int resolution, bool tile) {
  PreviewRequest request = preview_request(session, shown, resolution, tile);
  if (is_of(asked_, request)) return;
  const bool same_run = asked_ && asked_->request.material == request.material &&
                        asked_->request.resolution == request.resolution &&
                        asked_->request.tile == request.tile;
  const bool hurry = shown.kind == ShownDraw::Kind::selected || !same_run;
  if (!hurry && (waiting() || Clock::now() - asked_at_ < kUnhurried)) return;
  ask(std::move(request));
}

void PreviewFeed::ask(PreviewRequest request) {
  asked_at_ = Clock::now();
  if (is_of(foreseen_, request)) {
    asked_ = std::exchange(foreseen_, std::nullopt);
    if (early_) wake_();
  } else {
    foreseen_.reset();  // the worker forgets it for this
    early_.reset();
    const std::uint64_t ticket = worker_.request(request);
    asked_ = {std::move(request), ticket};
  }
  wanted_.insert(asked_->ticket);
}

void PreviewFeed::foresee(const Session& session, const ShownDraw& next, int resolution, bool tile) {
  if (waiting()) return;  // what is wanted comes first, and the worker keeps one request
  PreviewRequest request = preview_request(session, next, resolution, tile);
  if (is_of(asked_, request) || is_of(foreseen_, request)) return;
  early_.reset();
  const std::uint64_t ticket = worker_.request(request);
  foreseen_ = {std::move(request), ticket};
}

std::optional<Preview> PreviewFeed::take() {
  auto preview = worker_.take();
  if (preview && !wanted_.contains(preview->ticket)) {
    if (foreseen_ && preview->ticket == foreseen_->ticket) early_ = std::move(preview);
    preview.reset();
  }
  if (!preview && early_ && wanted_.contains(early_->ticket)) preview = std::exchange(early_, std::nullopt);
  if (!preview) return std::nullopt;
  taken_ticket_ = preview->ticket;
  wanted_.erase(wanted_.begin(), wanted_.upper_bound(taken_ticket_));
  return preview;
}

}  // namespace patina
