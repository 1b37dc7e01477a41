#include "engine/cli/picture_text.h"

#include <nlohmann/json.hpp>

#include "engine/format.h"

namespace patina {

std::string picture_table(const NeededPicture& needed) {
  std::string text =
      "pixels  summary           times as fast  differs most                 by             agrees\n";
  for (const CheaperPicture& picture : needed.tried)
    text += format("%6d  %-16s %14.1f  %-24s %6.2f +- %.2f  %s\n", picture.resolution,
                   picture.summary.c_str(), picture.times_as_fast, picture.differs_most.c_str(),
                   picture.difference, picture.error, picture.agrees ? "yes" : "no");
  return text + needed.sentence() + "\n";
}

nlohmann::ordered_json picture_json(const NeededPicture& needed) {
  auto tried = nlohmann::ordered_json::array();
  for (const CheaperPicture& picture : needed.tried)
    tried.push_back({{"resolution", picture.resolution},
                     {"summary", picture.summary},
                     {"times_as_fast", picture.times_as_fast},
                     {"differs_most", picture.differs_most},
                     {"difference", picture.difference},
                     {"error", picture.error},
                     {"agrees", picture.agrees}});
  return {{"tolerance", kTolerance}, {"tried", tried}, {"sentence", needed.sentence()}};
}

}  // namespace patina
