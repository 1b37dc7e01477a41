#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

/// One draw to take elsewhere.
struct ExportRequest {
  std::string material;
  std::uint64_t z_seed = 1;
  Capture capture;
  ParameterValues values;
  int resolution = 1024;  ///< pixels a side of the maps, 16 to 4096
  bool tile = false;      ///< maps that repeat without a seam (Renderer::tile), in place of the sample's
};

/// Writes a draw as files that any 3-D program reads, into a folder that is made if need be, each atomically:
///   params.json      parameter names to numbers, as `patina-cli render --params` takes them
///   render.png       the sample under the capture light, sRGB, 8 bit
///   base_color.png   sRGB, 16 bit
///   normal_gl.png    16 bit, (n + 1) / 2, +Y up (OpenGL and glTF convention)
///   roughness.png    16 bit, of the first lobe, as a number (no sRGB curve)
///   height.png       16 bit, lowest point 0 to highest point 1
///   maps.json        the heights in cm that 0 and 1 stand for, the maps' physical size, conventions,
///   provenance
/// @throws UserError for an unknown material, a resolution out of range, a tile of a material that has none,
/// or a folder that cannot be written
void export_draw(const ExportRequest& request, const std::filesystem::path& folder);

}  // namespace patina
