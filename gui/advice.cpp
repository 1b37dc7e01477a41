#include "gui/advice.h"

namespace patina {
namespace {

constexpr double kNotPinnedDown = 0.9;  // posterior sd over prior sd (QuantitySummary::sd_over_prior_sd)
constexpr double kEnoughDraws = 100;    // effective ones: the sd is known to 1 / sqrt(2 * 100), 7 %

}  // namespace

bool not_pinned_down(const QuantitySummary& quantity) { return quantity.sd_over_prior_sd > kNotPinnedDown; }

std::optional<LooseParameter> loosest(const Session& session) {
  if (!session.summary() || !session.run_is_of_choice()) return std::nullopt;
  const RunChoices& choices = session.choices();
  const QuantitySummary* found = nullptr;
  for (const QuantitySummary& quantity : session.summary()->quantities) {
    if (!choices.table().find_continuous(quantity.name) || choices.locked(quantity.name)) continue;
    if (!not_pinned_down(quantity) || !(quantity.bulk_ess >= kEnoughDraws)) continue;
    if (found == nullptr || quantity.sd_over_prior_sd > found->sd_over_prior_sd) found = &quantity;
  }
  if (found == nullptr) return std::nullopt;
  return LooseParameter{found->name, found->mean};
}

}  // namespace patina
