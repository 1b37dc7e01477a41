#include "engine/cli/draws_csv.h"

#include <charconv>

#include "engine/run/run_files.h"

namespace patina {
namespace {

void put(std::string& line, double value) {
  char text[32];
  line += ',';
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

}  // namespace

std::string draws_csv(const ParameterTable& table, const std::vector<Draw>& draws) {
  std::string text = "chain,draw,lp";
  for (const std::string& name : column_names(table)) text += "," + name;
  text += '\n';
  for (const Draw& draw : draws) {
    if (draw.warmup) continue;
    text += std::to_string(draw.chain + 1) + "," + std::to_string(draw.iteration + 1);
    put(text, draw.lp);
    for (const double value : draw.values.continuous) put(text, value);
    for (const int level : draw.values.discrete) text += "," + std::to_string(level);
    text += '\n';
  }
  return text;
}

}  // namespace patina
