#include "gui/preview/thumbnails.h"

#include <algorithm>

#include "gui/preview/shown_draw.h"

namespace patina {

Thumbnails::Thumbnails(const Gl& gl, std::function<void()> wake) : gl_(gl), wake_(std::move(wake)) {}

const Texture* Thumbnails::find(const Session& session, std::size_t draw, int resolution, bool hurry) {
  const Key key{session.run_version(), draw, resolution};
  if (const auto entry = entries_.find(key); entry != entries_.end()) {
    entry->second.used = frame_;
    return entry->second.picture ? &entry->second.picture->texture() : nullptr;
  }
  if (pending_ == key) return nullptr;
  const ShownDraw shown = selected_draw(session.model().draws(), draw);
  const auto place = hurry ? wanted_.begin() : wanted_.end();
  wanted_.insert(place, {key, preview_request(session, shown, resolution)});
  return nullptr;
}

void Thumbnails::serve() {
  ++frame_;
  if (pending_) take_in();
  if (!pending_ && !wanted_.empty()) {
    if (!worker_) worker_ = std::make_unique<PreviewWorker>(wake_);
    pending_ = wanted_.front().first;
    ticket_ = worker_->request(std::move(wanted_.front().second));
  }
  wanted_.clear();
}

void Thumbnails::take_in() {
  if (const auto preview = worker_->take()) {
    // Mipmaps would be waited for, and are not missed at about half size.
    if (!renderer_) renderer_.emplace(gl_, TextureFilter::linear);
    renderer_->set_maps(preview->maps);
    renderer_->render();
    entries_[*pending_] = {renderer_->take(), frame_};
  } else if (!worker_->error_of(ticket_).empty()) {
    entries_[*pending_] = {std::nullopt, frame_};
  } else {
    return;
  }
  pending_.reset();
  if (entries_.size() > kMost) forget_some();
}

void Thumbnails::forget_some() {
  const auto oldest =
      std::ranges::min_element(entries_, {}, [](const auto& entry) { return entry.second.used; });
  entries_.erase(oldest);
}

}  // namespace patina
