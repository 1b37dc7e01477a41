#include "gui/shown_draw.h"

#include <tuple>

namespace patina {

ShownDraw shown_draw(const Session& session) {
  const ExplorerModel& model = session.model();
  if (const auto selected = model.selected()) {
    return {ShownDraw::Kind::selected, selected, model.draws().lp(*selected),
            model.draws().values(*selected)};
  }
  const RunStatus& status = session.status();
  const auto best = model.best();
  if (best && (!status.best || model.draws().lp(*best) >= status.best_lp)) {
    return {ShownDraw::Kind::best, best, model.draws().lp(*best), model.draws().values(*best)};
  }
  if (status.best) return {ShownDraw::Kind::search, std::nullopt, status.best_lp, *status.best};
  return {ShownDraw::Kind::typical, std::nullopt, 0,
          session.has_run() ? prior_location(model.table()) : session.choices().typical()};
}

std::string shown_draw_title(const ShownDraw& shown) {
  switch (shown.kind) {
    case ShownDraw::Kind::selected:
      return "Selected draw";
    case ShownDraw::Kind::best:
      return "Best draw so far";
    case ShownDraw::Kind::search:
      return "Best match found";
    case ShownDraw::Kind::typical:
      return "Typical of the material";
  }
  return {};
}

PreviewRequest preview_request(const Session& session, const ShownDraw& shown, int resolution, bool tile) {
  const RunSettings& settings = session.has_run() ? session.run().settings() : session.settings();
  return {settings.material, settings.z_seed, settings.capture, shown.values, resolution, tile};
}

bool same_picture(const PreviewRequest& a, const PreviewRequest& b) {
  const auto key = [](const PreviewRequest& r) {
    return std::tie(r.material, r.z_seed, r.capture, r.values, r.resolution, r.tile);
  };
  return key(a) == key(b);
}

}  // namespace patina
