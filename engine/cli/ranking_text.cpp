#include "engine/cli/ranking_text.h"

#include <cmath>
#include <cstdio>

namespace patina {
namespace {

std::string line_of(const RankedMaterial& m) {
  char evidence[32], text[128];
  if (m.error)
    std::snprintf(evidence, sizeof evidence, "%9.1f +- %.1f", m.log_evidence, *m.error);
  else
    std::snprintf(evidence, sizeof evidence, "%9.1f  about", m.log_evidence);
  std::snprintf(text, sizeof text, "%-12s %-18s %11.2g %11d %7.1f %9.1f\n", m.material.c_str(), evidence,
                m.probability, m.parameters, m.misfit, m.seconds);
  return text;
}

}  // namespace

std::string ranking_table(const MaterialRanking& ranking) {
  std::string text = "material      log evidence      probability  parameters  misfit   seconds\n";
  for (const RankedMaterial& material : ranking.materials) text += line_of(material);
  return text + ranking.sentence + "\n";
}

std::function<void(double, const std::string&)> ranking_progress(bool quiet) {
  if (quiet) return {};
  return [last = std::string()](double fraction, const std::string& doing) mutable {
    if (doing == last) return;
    last = doing;
    std::fprintf(stderr, "%3.0f %%  %s\n", std::floor(100 * fraction), doing.c_str());
  };
}

}  // namespace patina
