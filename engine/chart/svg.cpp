#include <string>

#include "engine/chart/scene.h"
#include "engine/format.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"

namespace patina {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

std::string number(double value) { return format("%.2f", value); }

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + value + "\"";
}

/// `name` and `name`-opacity.
std::string paint(const std::string& name, const Colour& colour) {
  return attribute(name, format("#%02x%02x%02x", colour.red, colour.green, colour.blue)) +
         (colour.opacity < 1 ? attribute(name + "-opacity", number(colour.opacity)) : "");
}

std::string element(const SceneLine& line) {
  return "<line" + attribute("x1", number(line.from.x)) + attribute("y1", number(line.from.y)) +
         attribute("x2", number(line.to.x)) + attribute("y2", number(line.to.y)) +
         paint("stroke", line.colour) + attribute("stroke-width", number(line.width)) + "/>\n";
}

std::string element(const SceneDisc& disc) {
  return "<circle" + attribute("cx", number(disc.centre.x)) + attribute("cy", number(disc.centre.y)) +
         attribute("r", number(disc.radius)) + paint("fill", disc.fill) + paint("stroke", disc.rim) +
         attribute("stroke-width", number(disc.rim_width)) + "/>\n";
}

std::string element(const SceneText& text) {
  const char* anchor = text.anchor == Anchor::start    ? "start"
                       : text.anchor == Anchor::middle ? "middle"
                                                       : "end";
  return "<text" + attribute("x", number(text.at.x)) + attribute("y", number(text.at.y)) +
         attribute("text-anchor", anchor) + attribute("font-size", number(text.size)) +
         (text.strong ? attribute("font-weight", "600") : "") + paint("fill", text.colour) + ">" +
         escaped(text.text) + "</text>\n";
}

}  // namespace

double text_width(const std::string& text, double size) {
  constexpr double kMeanAdvance = 0.55;  // of Inter's letters, in ems
  double letters = 0;
  for (const char c : text) letters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // UTF-8's first bytes
  return kMeanAdvance * size * letters;
}

std::string to_svg(const Scene& scene) {
  const std::string width = std::to_string(scene.width), height = std::to_string(scene.height);
  std::string svg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"" +
                    attribute("width", width) + attribute("height", height) +
                    attribute("viewBox", "0 0 " + width + " " + height) +
                    attribute("font-family", "Inter, DejaVu Sans, sans-serif") + ">\n<title>" +
                    escaped(scene.title) + "</title>\n<rect" + attribute("width", width) +
                    attribute("height", height) + attribute("fill", "#ffffff") + "/>\n";
  for (const auto& shape : scene.shapes) svg += std::visit([](const auto& s) { return element(s); }, shape);
  return svg + "</svg>\n";
}

void write_scene(const std::filesystem::path& folder, const std::string& name, const Scene& scene) {
  write_file_atomically(folder / (name + ".svg"), to_svg(scene));
  write_image(folder / (name + ".png"), to_image(scene));
}

}  // namespace patina
