#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

/// The kind of image that the first bytes of a file show, as OpenImageIO names its readers: "jpeg", "png",
/// "tiff", "openexr", "webp", "heif", "jpeg2000", "hdr", "bmp", "pnm"; empty for anything else. Contents
/// decide, not the extension: left to itself OpenImageIO hands an unknown file to every reader that it has,
/// video and medical ones included.
std::string image_format(std::string_view bytes);

/// Whether the name is that of a camera's raw file. Most are TIFF inside and would be taken for the small
/// preview that they carry.
bool is_camera_raw(const std::filesystem::path& file);

/// Whether an image reaches its own end. Decoders tend to warn of a missing one and paint the rest grey. What
/// follows the end is not looked at: phones append videos and further images.
/// JPEG: the end-of-image marker of the primary image, by walking the segments (ITU T.81, annex B).
/// PNG: the IEND chunk, by walking the chunks. WebP: the RIFF size. Other formats: always true, their readers
/// notice.
bool image_is_complete(std::string_view bytes);

/// The number of colour components in a JPEG's frame header (1 grey, 3 colour, 4 CMYK); 0 if there is none.
int jpeg_components(std::string_view bytes);

}  // namespace patina
