// patina in a real window, on a display without a screen: dropped on, clicked, typed at, closed.
#include <gtest/gtest.h>

#include "engine/io/temporary_folder.h"
#include "tests/window/looking.h"
#include "tests/window/x_server.h"

namespace patina {
namespace {

constexpr int kWidth = 1280, kHeight = 800;

TEST(RealWindow, opens_takes_a_dropped_photo_a_click_and_a_key_and_closes) {
  const auto server = XServer::start(kWidth, kHeight);
  if (!server) GTEST_SKIP() << "Xvfb does not start: install the test packages (packaging/packages.txt).";
  const TemporaryFolder home;
  const std::filesystem::path photo = home.path() / "A dropped photo.png";
  std::filesystem::copy_file(std::filesystem::path(PATINA_SOURCE_DIR) / "resources/photos/sample_bump.png",
                             photo);
  Program patina = start_patina(server->display(), home.path());
  const Desktop desktop(server->display());
  ASSERT_TRUE(comes_true([&] { return desktop.window().has_value(); })) << "no window";
  const Desktop::Window window = *desktop.window();
  ASSERT_TRUE(comes_true([&] { return desktop.title(window).starts_with("sample"); }))
      << desktop.title(window);

  ASSERT_TRUE(desktop.drop(window, home.path() / "A%20dropped%20photo.png"));
  EXPECT_TRUE(comes_true([&] { return desktop.title(window).starts_with("A dropped photo"); }))
      << desktop.title(window);

  // The sheet dims all of the window; what else may come meanwhile, as what the photo shows at a glance, is
  // less.
  constexpr double kSheet = 0.9;
  const Desktop::Picture without_help = settled(desktop, window);  // no run is open
  desktop.press("question");
  EXPECT_TRUE(comes_true([&] { return difference(desktop.picture(window), without_help) > kSheet; }))
      << "a key opens the help sheet";
  const Desktop::Picture with_help = settled(desktop, window);
  desktop.press("Escape");
  EXPECT_TRUE(comes_true([&] { return difference(desktop.picture(window), with_help) > kSheet; }))
      << "another closes it";

  const std::filesystem::path runs = home.path() / "patina" / "runs";
  const std::size_t before = runs_in(runs).size();
  std::optional<Place> start;
  ASSERT_TRUE(comes_true([&] { return (start = find_bar(desktop.picture(window), kAccent)).has_value(); }))
      << "no button says what to do next";
  desktop.click(start->x, start->y + 8);
  EXPECT_TRUE(comes_true([&] { return runs_in(runs).size() == before + 1; })) << "the click starts a run";

  desktop.close(window);
  EXPECT_EQ(patina.wait(), 0);
}

}  // namespace
}  // namespace patina
