#include "engine/cli/ranking_text.h"

#include <cmath>
#include <cstdio>

#include "engine/comparison/ranking_words.h"
#include "engine/format.h"

namespace patina {
namespace {

std::string line_of(const RankedMaterial& m) {
  const std::string misfit = m.misfit ? format("%.1f", *m.misfit) : "";
  const std::string evidence =
      m.error ? format("%9.1f +- %.1f", m.log_evidence, *m.error) : format("%9.1f  about", m.log_evidence);
  const std::string quarters = m.quarters.empty() ? "" : format("%.1f", foretold(m));
  const std::string glance = m.glance != 0 ? format("%.1f", m.glance) : "";
  return format("%-12s %-18s %7s %9s %11.2g %11d %7s %9.1f\n", m.material.c_str(), evidence.c_str(),
                glance.c_str(), quarters.c_str(), m.probability, m.parameters, misfit.c_str(), m.seconds);
}

}  // namespace

std::string ranking_table(const MaterialRanking& ranking) {
  std::string text =
      "material      log evidence         glance  quarters probability  parameters  misfit   seconds\n";
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
