#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "engine/run/export_draw.h"
#include "engine/run/preview_worker.h"
#include "gui/session.h"

namespace patina {

/// The point of the parameter space whose render is in the window.
struct ShownDraw {
  enum class Kind {
    selected,  ///< the draw that was clicked
    best,      ///< the draw with the highest lp so far
    search,    ///< the best point of the search for a match, while it is better than any draw
    typical    ///< the middle of the material's prior: no run is open
  };
  Kind kind = Kind::typical;
  std::optional<std::size_t> draw;  ///< its index, for selected and best
  double lp = 0;                    ///< not for typical
  ParameterValues values;
};

ShownDraw shown_draw(const Session& session);

/// As if that draw had been selected.
ShownDraw selected_draw(const DrawColumns& draws, std::size_t draw);

/// "Selected draw", "Best draw so far" ...
std::string shown_draw_title(const ShownDraw& shown);

/// What has to be rendered for it. @param resolution pixels a side @param tile see PreviewRequest
PreviewRequest preview_request(const Session& session, const ShownDraw& shown, int resolution,
                               bool tile = false);

/// What has to be exported of it, and a name for the folder.
ExportRequest export_request(const Session& session, const ShownDraw& shown);
std::string export_name(const Session& session, const ShownDraw& shown);

/// "chain2-step1405": a draw's place in the run, for names of files.
std::string place_name(const DrawColumns& draws, std::size_t draw);

/// Whether two requests have the same picture.
bool same_picture(const PreviewRequest& a, const PreviewRequest& b);

}  // namespace patina
