#include "gui/arguments.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "engine/error.h"

namespace patina {
namespace {

void read_size(const std::string& text, Arguments& arguments) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 640 || height < 480 ||
      width > 8192 || height > 8192) {
    throw UserError("--size " + text + " is not a size: write it as 1280x800, from 640x480 to 8192x8192.");
  }
  arguments.width = width;
  arguments.height = height;
}

}  // namespace

std::optional<Arguments> parse_arguments(int argc, char** argv) {
  Arguments arguments;
  std::string input, offscreen, size;
  CLI::App app("Patina shows which procedural materials could have made a flash photo of a surface.",
               "patina");
  app.add_option("photo", input,
                 "A photo, or the directory of a run; without it the last run, at first a bundled sample")
      ->type_name("PHOTO|RUN_DIR");
  app.add_option("--material", arguments.material, "The material to begin with")->type_name("NAME");
  app.add_option("--offscreen", offscreen,
                 "Run without a display and save a picture of the window at the end")
      ->type_name("FILE.png");
  app.add_option("--seconds", arguments.seconds, "How long to run off screen")
      ->capture_default_str()
      ->type_name("S");
  app.add_option("--size", size, "Size of the window; without it as it was left, at first 1280x800")
      ->type_name("WxH");
  app.set_version_flag("--version", "patina " PATINA_VERSION, "Print the version");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    app.exit(request);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UserError(std::string(error.what()) + " (patina --help shows how to call it).");
  }
  if (!size.empty()) read_size(size, arguments);
  if (!(arguments.seconds >= 0 && arguments.seconds <= 86400))
    throw UserError("--seconds must lie between 0 and 86400.");
  if (!offscreen.empty() && !offscreen.ends_with(".png")) {
    throw UserError("--offscreen " + offscreen + " is no picture: name a file that ends in .png.");
  }
  arguments.input = input;
  arguments.offscreen = offscreen;
  return arguments;
}

}  // namespace patina
