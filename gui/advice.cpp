#include "gui/advice.h"

#include <algorithm>

#include "engine/run/verdict.h"
#include "gui/words.h"

namespace patina {
namespace {

bool not_needed(const ParameterAdvice& advice) {
  return advice.off && advice.off->ratio - 2 * advice.off->error > kUnneeded;
}

}  // namespace

bool not_pinned_down(const QuantitySummary& quantity) { return quantity.sd_over_prior_sd > kNotIdentified; }

std::vector<ParameterAdvice> advice_for_next_run(const Session& session) {
  if (!session.run_is_of_choice()) return {};
  std::vector<ParameterAdvice> advice = session.advice();
  std::erase_if(advice, [&](const ParameterAdvice& a) {
    return a.sentence.empty() || session.choices().locked(a.name);
  });
  return advice;
}

std::string advice_title(const ParameterAdvice& advice) {
  const std::string label = parameter_label(advice.name);
  if (not_needed(advice)) return label + " is not needed";
  if (!advice.identified) return label + " is not pinned down";
  return label + " and " + parameter_label(advice.redundant_with) + " trade against each other";
}

std::string advice_sentence(const ParameterAdvice& advice) {
  const std::string title = advice_title(advice) + ": ";
  const std::string hold = advice.freeze_at ? " It can be held at " + number_text(*advice.freeze_at) + "."
                                            : " Held, it would change the others: leave it free.";
  if (not_needed(advice))
    return title + "the photo makes it " + number_text(advice.off->ratio, 2) +
           " times likelier than before that it is absent (" + number_text(advice.off->value) + ")." + hold;
  if (!advice.identified)
    return title + number_text(100 * advice.sd_over_prior_sd, 2) +
           " % of its spread before looking is left." + hold;
  return title + "the photo tells little more than how they go together.";
}

std::string holdable_text(const std::vector<ParameterAdvice>& advice) {
  std::string names;
  for (const ParameterAdvice& a : advice)
    if (a.freeze_at) names += (names.empty() ? "" : ", ") + parameter_label(a.name);
  return names.empty() ? names : "The photo leaves open: " + names;
}

}  // namespace patina
