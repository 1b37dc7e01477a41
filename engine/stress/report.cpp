#include "engine/stress/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/format.h"
#include "engine/number_json.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string error_text(const Error& error) {
  if (!std::isfinite(error.size)) return "no answer";
  return format("%.2f", error.size) + (std::isfinite(error.mcse) ? " ± " + format("%.2f", error.mcse) : "");
}

std::string counts(const std::vector<Cell>& cells) {
  std::string text;
  for (const Outcome each : {Outcome::right, Outcome::alarmed, Outcome::refused, Outcome::silent})
    text += (text.empty() ? "" : ", ") + word(each) + " " +
            std::to_string(std::ranges::count(cells, each, &Cell::outcome));
  double seconds = 0;
  for (const Cell& cell : cells) seconds += cell.evidence.seconds;
  return text + "; " + format("%.0f", seconds) + " s in all";
}

}  // namespace

std::string cell_text(const Cell& cell) {
  std::string text = word(cell.outcome);
  if (cell.outcome == Outcome::refused) return text;
  text += " " + error_text(cell.evidence.error);
  const std::string said = joined(warnings(cell.evidence));
  return said.empty() ? text : text + " (" + said + ")";
}

std::string report_table(const std::vector<Cell>& cells) {
  std::vector<std::string> kernels;
  for (const Cell& cell : cells)
    if (cell.scenario == cells.front().scenario) kernels.push_back(cell.kernel);
  std::string text = "| scenario | known by |", rule = "|---|---|";
  for (const std::string& kernel : kernels) text += " " + kernel + " |", rule += "---|";
  text += " s |\n" + rule + "---|\n";
  for (std::size_t i = 0; i < cells.size(); i += kernels.size()) {
    text += "| **" + cells[i].scenario + "**: " + cells[i].what + " | " + cells[i].known_by + " |";
    double seconds = 0;
    for (std::size_t k = i; k < i + kernels.size(); ++k) {
      text += " " + cell_text(cells[k]) + " |";
      seconds += cells[k].evidence.seconds;
    }
    text += " " + format("%.1f", seconds) + " |\n";
  }
  return text + "\n" + counts(cells) + ".\n";
}

std::string with_table(const std::string& page, const std::string& command, const std::string& table) {
  const std::string first = "<!-- " + command + " -->\n", last = "<!-- /" + command + " -->\n";
  const std::string part = first + table + last;
  const auto begin = page.find(first), end = page.find(last);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    return page.empty() ? part : page + "\n" + part;
  return page.substr(0, begin) + part + page.substr(end + last.size());
}

Json report_json(const std::vector<Cell>& cells) {
  Json list = Json::array();
  for (const Cell& cell : cells) {
    Json alarms = Json::array();
    for (const Alarm& alarm : cell.evidence.alarms)
      alarms.push_back({{"name", alarm.name}, {"sentence", alarm.sentence}});
    list.push_back({{"scenario", cell.scenario},
                    {"kernel", cell.kernel},
                    {"outcome", word(cell.outcome)},
                    {"of", cell.evidence.error.name},
                    {"error", number_json(cell.evidence.error.size)},
                    {"mcse", number_json(cell.evidence.error.mcse)},
                    {"warnings", warnings(cell.evidence)},
                    {"alarms", alarms},
                    {"refusal", cell.evidence.refusal},
                    {"seconds", number_json(cell.evidence.seconds)}});
  }
  return {{"cells", list}};
}

}  // namespace patina
