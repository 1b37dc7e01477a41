#include "gui/directory_listing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <tuple>

#include "engine/error.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

/// What load_photo() reads; a file with another name may still be dropped or typed in.
constexpr std::array<std::string_view, 12> kImageExtensions{".jpg", ".jpeg", ".png", ".tif", ".tiff", ".exr",
                                                            ".hdr", ".webp", ".bmp", ".ppm", ".jp2",  ".j2k"};

/// %20 and the like as the bytes that they stand for.
std::string decoded(const std::string& address) {
  std::string path;
  for (std::size_t i = 0; i < address.size(); ++i) {
    unsigned byte = 0;
    const char* digits = address.data() + i + 1;
    const bool escaped = address[i] == '%' && i + 2 < address.size() &&
                         std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    path += escaped ? static_cast<char>(byte) : address[i];
    if (escaped) i += 2;
  }
  return path;
}

}  // namespace

bool looks_like_image(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return std::find(kImageExtensions.begin(), kImageExtensions.end(), extension) != kImageExtensions.end();
}

bool looks_like_run(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "run.json", ignored);
}

std::vector<DirectoryEntry> list_directory(const fs::path& folder) {
  std::error_code error;
  std::vector<DirectoryEntry> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    if (name.starts_with('.')) continue;
    if (it->is_directory(ignored)) {
      entries.push_back(
          {looks_like_run(*it) ? DirectoryEntry::Kind::run : DirectoryEntry::Kind::folder, name});
    } else if (it->is_regular_file(ignored) && looks_like_image(*it)) {
      entries.push_back({DirectoryEntry::Kind::image, name});
    }
  }
  if (error)
    throw UserError("The folder " + folder.string() + " cannot be read (" + error.message() +
                    "); choose another one.");
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return std::tie(a.kind, a.name) < std::tie(b.kind, b.name); });
  return entries;
}

fs::path typed_path(const std::string& text, const fs::path& folder) {
  constexpr const char* kAround = " \t\r\n'\"";
  const auto first = text.find_first_not_of(kAround);
  if (first == std::string::npos) return folder;
  std::string path = text.substr(first, text.find_last_not_of(kAround) - first + 1);
  if (path.starts_with("file://")) path = decoded(path.substr(7));
  const char* home = std::getenv("HOME");
  if (home != nullptr && (path == "~" || path.starts_with("~/"))) path.replace(0, 1, home);
  return (folder / path).lexically_normal();
}

}  // namespace patina
