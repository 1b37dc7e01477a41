#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

enum class MapFormat {
  png8,  ///< small; slopes and heights show steps
  png16,
  exr  ///< base colour linear, heights in cm
};
std::vector<std::string> map_format_names();  ///< "png8", "png16", "exr"; in the order of MapFormat

/// Which way green leans in a normal map.
enum class NormalConvention { opengl, directx };  ///< up; down
std::vector<std::string> normal_convention_names();

/// Where a draw comes from, in words; what is empty is left out.
struct DrawOrigin {
  std::string photo;  ///< the file's name
  std::string photo_sha256;
  std::string run;   ///< the run directory's name
  std::string draw;  ///< "chain 2, step 153"
};

/// One draw to take elsewhere.
struct ExportRequest {
  std::string material;
  std::uint64_t z_seed = 1;
  Capture capture;
  ParameterValues values;
  int resolution = 1024;  ///< pixels a side of the maps, 16 to 4096
  bool tile = false;      ///< maps that repeat without a seam (Renderer::tile), in place of the sample's
  MapFormat format = MapFormat::png16;
  NormalConvention normals = NormalConvention::opengl;
  DrawOrigin origin = {};
};

/// A file of an export, in an artist's words.
struct ExportedFile {
  std::string name;  ///< "normal_gl.png"
  std::string description;
  std::string color_space;  ///< "sRGB", "linear" or "raw" (numbers, not colours); empty: no image
};

/// What export_draw() writes: params.json (as `patina-cli render --params` takes it), render.png (sRGB, 8
/// bit), base_color, normal_gl or normal_dx ((n + 1) / 2), roughness (of the first lobe; left out where there
/// is none), height, and maps.json, which says all that the images do not: the heights in cm of black and
/// white, the maps' physical size, conventions, origin.
std::vector<ExportedFile> exported_files(MapFormat format, NormalConvention normals);

/// Told between two parts of an export how much of it is done, 0 to 1. What it throws ends the export; files
/// that were written stay.
using ExportProgress = std::function<void(double done)>;

/// Writes a draw as files that any 3-D program reads, into a folder that is made if need be, each atomically.
/// @param progress  may be empty
/// @throws UserError for an unknown material, a resolution out of range, a tile of a material that has none,
/// or a folder that cannot be written
void export_draw(const ExportRequest& request, const std::filesystem::path& folder,
                 const ExportProgress& progress = {});

}  // namespace patina
