#include "gui/preview/shown_draw.h"

#include <tuple>

namespace patina {

ShownDraw shown_draw(const Session& session) {
  const ExplorerModel& model = session.model();
  if (const auto selected = model.selected()) return selected_draw(model.draws(), *selected);
  const RunStatus& status = session.status();
  const auto best = model.best();
  if (best && (!status.best || model.draws().lp(*best) >= status.best_lp)) {
    return {ShownDraw::Kind::best, best, model.draws().lp(*best), model.draws().values(*best)};
  }
  if (status.best) return {ShownDraw::Kind::search, std::nullopt, status.best_lp, *status.best};
  return {ShownDraw::Kind::typical, std::nullopt, 0,
          session.has_run() ? prior_location(model.table()) : session.choices().typical()};
}

ShownDraw selected_draw(const DrawColumns& draws, std::size_t draw) {
  return {ShownDraw::Kind::selected, draw, draws.lp(draw), draws.values(draw)};
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

ExportRequest export_request(const Session& session, const ShownDraw& shown) {
  const PreviewRequest picture = preview_request(session, shown, 0);
  ExportRequest request;
  request.material = picture.material;
  request.z_seed = picture.z_seed;
  request.capture = picture.capture;
  request.values = picture.values;
  if (session.has_photo()) {
    request.origin.photo = session.photo_file().filename().string();
    request.origin.photo_sha256 = session.photo().sha256;
  }
  if (session.has_run()) request.origin.run = session.run().directory().filename().string();
  request.origin.draw = shown_draw_title(shown);
  if (shown.draw) {
    const DrawColumns& draws = session.model().draws();
    request.origin.draw = "chain " + std::to_string(draws.chain(*shown.draw) + 1) + ", step " +
                          std::to_string(draws.iteration(*shown.draw) + 1);
  }
  return request;
}

std::string export_name(const Session& session, const ShownDraw& shown) {
  const RunSettings& settings = session.has_run() ? session.run().settings() : session.settings();
  std::string name = settings.material;
  if (session.has_photo()) name = session.photo_name() + "-" + name;
  return shown.draw ? name + "-" + place_name(session.model().draws(), *shown.draw) : name;
}

std::string place_name(const DrawColumns& draws, std::size_t draw) {
  return "chain" + std::to_string(draws.chain(draw) + 1) + "-step" +
         std::to_string(draws.iteration(draw) + 1);
}

bool same_picture(const PreviewRequest& a, const PreviewRequest& b) {
  const auto key = [](const PreviewRequest& r) {
    return std::tie(r.material, r.z_seed, r.capture, r.values, r.resolution, r.tile);
  };
  return key(a) == key(b);
}

}  // namespace patina
