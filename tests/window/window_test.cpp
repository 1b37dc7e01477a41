// patina in a real window, on a display without a screen: dropped on, clicked, typed at, closed.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>

#include "tests/support/temporary_folder.h"
#include "tests/window/desktop.h"
#include "tests/window/x_server.h"

namespace patina {
namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr std::uint32_t kAccent = 0x58b8a0;  // of the button that says what to do next (gui/theme.h)

/// Waits up to two minutes: machines are slow. Returns whether it came true.
bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 1200; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(100)))
    if (condition()) return true;
  return false;
}

std::filesystem::path program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "patina";
}

/// Share of pixels that differ.
double difference(const Desktop::Picture& a, const Desktop::Picture& b) {
  if (a.pixels.size() != b.pixels.size()) return 1;
  double differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) differing += a.pixels[i] != b.pixels[i];
  return differing / static_cast<double>(a.pixels.size());
}

/// The window once nothing in it has changed for two seconds.
Desktop::Picture settled(const Desktop& desktop, Desktop::Window window) {
  Desktop::Picture picture = desktop.picture(window);
  int still = 0;
  comes_true([&] {
    Desktop::Picture next = desktop.picture(window);
    still = next.pixels == picture.pixels ? still + 1 : 0;
    picture = std::move(next);
    return still == 20;
  });
  return picture;
}

struct Place {
  int x = 0, y = 0;
};

/// The middle of the first row of at least 60 pixels of a colour.
std::optional<Place> find_bar(const Desktop::Picture& picture, std::uint32_t colour) {
  for (int y = 0; y < picture.height; ++y) {
    int length = 0;
    for (int x = 0; x < picture.width; ++x) {
      const bool same = picture.pixels[static_cast<std::size_t>(y) * picture.width + x] == colour;
      if (!same && length >= 60) return Place{x - length / 2, y};
      length = same ? length + 1 : 0;
    }
  }
  return std::nullopt;
}

int count_runs(const std::filesystem::path& runs) {
  if (!std::filesystem::is_directory(runs)) return 0;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(runs))
    count += std::filesystem::exists(entry.path() / "run.json");
  return count;
}

TEST(RealWindow, opens_takes_a_dropped_photo_a_click_and_a_key_and_closes) {
  const auto server = XServer::start(kWidth, kHeight);
  if (!server) GTEST_SKIP() << "Xvfb does not start: install the test packages (packaging/packages.txt).";
  const TemporaryFolder home;
  const std::filesystem::path photo = home.path() / "A dropped photo.png";
  std::filesystem::copy_file(std::filesystem::path(PATINA_SOURCE_DIR) / "resources/photos/sample_bump.png",
                             photo);
  Program patina({program().string(), "--size", "1280x800"}, {{"DISPLAY", server->display()},
                                                              {"HOME", home.path().string()},
                                                              {"XDG_DATA_HOME", home.path().string()},
                                                              {"XDG_CONFIG_HOME", home.path().string()}});
  const Desktop desktop(server->display());
  ASSERT_TRUE(comes_true([&] { return desktop.window().has_value(); })) << "no window";
  const Desktop::Window window = *desktop.window();
  ASSERT_TRUE(comes_true([&] { return desktop.title(window).starts_with("sample"); }))
      << desktop.title(window);

  ASSERT_TRUE(desktop.drop(window, home.path() / "A%20dropped%20photo.png"));
  EXPECT_TRUE(comes_true([&] { return desktop.title(window).starts_with("A dropped photo"); }))
      << desktop.title(window);

  const Desktop::Picture without_help = settled(desktop, window);  // no run is open
  desktop.press("question");
  EXPECT_TRUE(comes_true([&] { return difference(desktop.picture(window), without_help) > 0.05; }))
      << "a key opens the help sheet";
  desktop.press("Escape");
  EXPECT_TRUE(comes_true([&] { return difference(desktop.picture(window), without_help) < 0.01; }))
      << "another closes it";

  const std::filesystem::path runs = home.path() / "patina" / "runs";
  const int before = count_runs(runs);
  std::optional<Place> start;
  ASSERT_TRUE(comes_true([&] { return (start = find_bar(desktop.picture(window), kAccent)).has_value(); }))
      << "no button says what to do next";
  desktop.click(start->x, start->y + 8);
  EXPECT_TRUE(comes_true([&] { return count_runs(runs) == before + 1; })) << "the click starts a run";

  desktop.close(window);
  EXPECT_EQ(patina.wait(), 0);
}

}  // namespace
}  // namespace patina
