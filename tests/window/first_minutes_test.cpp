// A new user's first five minutes in a real window, without the README, and what the window shows at each
// step:
//   PATINA_FIRST_MINUTES=FOLDER build/test/bin/test-window --gtest_filter='FirstMinutes*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "engine/io/image_file.h"
#include "engine/io/temporary_folder.h"
#include "tests/window/looking.h"
#include "tests/window/x_server.h"

namespace patina {
namespace {

constexpr int kScreenWidth = 1280, kScreenHeight = 800;

Image image_of(const Desktop::Picture& picture) {
  Image image(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = static_cast<float>(picture.pixels[i] >> (16 - 8 * c) & 255) / 255;
  return image;
}

/// Whether a pixel is a point of the first chain (gui/window/theme.h) over the plot's ground.
bool is_point(std::uint32_t pixel) {
  constexpr int kRed = 72, kGreen = 146, kBlue = 187;
  const auto near = [](std::uint32_t value, int wanted) {
    return std::abs(static_cast<int>(value & 255) - wanted) < 8;
  };
  return near(pixel >> 16, kRed) && near(pixel >> 8, kGreen) && near(pixel, kBlue);
}

/// The middle of a point in the plot.
std::optional<Place> find_point(const Desktop::Picture& picture) {
  const auto at = [&](int x, int y) {
    return picture.pixels[static_cast<std::size_t>(y) * picture.width + x];
  };
  for (int y = 180; y < 700; ++y)
    for (int x = 440; x < 800; ++x)
      if (is_point(at(x, y)) && is_point(at(x + 1, y + 1)) && is_point(at(x + 1, y)) &&
          is_point(at(x, y + 1)))
        return Place{x + 1, y + 1};
  return std::nullopt;
}

std::size_t lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
}

class FirstMinutes : public ::testing::Test {
 protected:
  void keep(const std::string& step) {
    const auto picture = desktop_->picture(window_);
    write_image(pictures_ / (std::to_string(++steps_) + "-" + step + ".png"), image_of(picture));
  }

  /// Waits until the eye finds something in the window. @return where
  std::optional<Place> look_for(const std::function<std::optional<Place>(const Desktop::Picture&)>& find) {
    std::optional<Place> place;
    comes_true([&] { return (place = find(desktop_->picture(window_))).has_value(); },
               std::chrono::milliseconds(100));
    return place;
  }

  /// Presses a key, gives the window a moment to answer, and keeps what it shows.
  void press(const std::string& key, const std::string& step) {
    desktop_->press(key);
    pause(2);
    keep(step);
  }

  void command(const std::string& name) {
    desktop_->press("ctrl+k");
    pause(0.6);
    desktop_->type(name);
    pause(0.6);
    desktop_->press("Return");
  }

  static void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

  std::unique_ptr<XServer> server_;  // goes after who looks at it
  std::filesystem::path pictures_;
  std::unique_ptr<Desktop> desktop_;
  Desktop::Window window_ = 0;
  int steps_ = 0;
};

TEST_F(FirstMinutes, GoWithoutTheReadme) {
  const char* folder = std::getenv("PATINA_FIRST_MINUTES");
  if (folder == nullptr)
    GTEST_SKIP() << "takes minutes: name a folder for its pictures in PATINA_FIRST_MINUTES.";
  const std::filesystem::path photo = std::filesystem::path(PATINA_SHARED_DIR) / "photos" / "leather_3.jpg";
  if (!std::filesystem::exists(photo)) GTEST_SKIP() << "needs the photo " << photo;
  server_ = XServer::start(kScreenWidth, kScreenHeight);
  if (!server_) GTEST_SKIP() << "Xvfb does not start: install the test packages (packaging/packages.txt).";
  pictures_ = folder;
  std::filesystem::create_directories(pictures_);
  const TemporaryFolder home;
  const std::filesystem::path runs = home.path() / "patina" / "runs";
  Program patina = start_patina(server_->display(), home.path());
  desktop_ = std::make_unique<Desktop>(server_->display());

  // Start.
  ASSERT_TRUE(comes_true([&] { return desktop_->window().has_value(); })) << "no window";
  window_ = *desktop_->window();
  keep("starting");
  ASSERT_TRUE(comes_true([&] { return runs_in(runs).size() == 1; })) << "the sample starts by itself";
  pause(3);
  keep("sample");

  // Drop a photo.
  ASSERT_TRUE(desktop_->drop(window_, std::filesystem::canonical(photo)));
  ASSERT_TRUE(comes_true([&] { return desktop_->title(window_).starts_with("leather_3"); }));
  pause(2);
  keep("dropped");

  // Choose leather, start.
  command("material: leather");
  pause(2);
  keep("leather");
  const auto start = look_for([](const auto& picture) { return find_bar(picture, kAccent); });
  ASSERT_TRUE(start) << "the button to start with";
  desktop_->click(start->x, start->y + 8);
  std::filesystem::path run;
  ASSERT_TRUE(comes_true([&] {
    for (const auto& each : runs_in(runs))
      if (each.filename().string().starts_with("leather_3-leather")) run = each;
    return !run.empty();
  })) << "the click starts a run";
  pause(2);
  keep("searching");

  // Watch.
  for (int patience = 0; patience < 5; ++patience)
    if (comes_true(
            [&] { return std::filesystem::exists(run / "chain-1.csv") && lines(run / "chain-1.csv") > 60; }))
      break;
  keep("first-draws");
  const auto point = look_for(find_point);
  ASSERT_TRUE(point) << "a draw to click";

  // Click, compare.
  desktop_->click(point->x, point->y);
  pause(2);
  keep("clicked");
  press("w", "compared");

  // Star.
  desktop_->press("s");
  EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(run / "stars.json"); }))
      << "a star is kept at once";
  press("g", "gallery");

  // Export.
  press("ctrl+e", "export");
  desktop_->press("Return");
  EXPECT_TRUE(comes_true([&] {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(home.path()))
      if (entry.path().filename() == "maps.json") return true;
    return false;
  })) << "the maps lie in the folder that was offered";
  pause(2);
  keep("exported");

  desktop_->close(window_);
  EXPECT_EQ(patina.wait(), 0);
  EXPECT_GT(lines(run / "chain-1.csv"), 60u) << "closing keeps the run";
}

}  // namespace
}  // namespace patina
