#include "gui/run_outlook.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/run/verdict.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kUsableRhat = 1.1;
constexpr double kLeastEss = 40;       // below, neither ESS nor R-hat is known well enough to go by
constexpr double kFurthestGuess = 30;  // times as many draws as there are: further no guess is honest

/// Seconds until every chain has made so many steps; chains go on side by side. None: nothing moves.
std::optional<double> seconds_to(double steps, const RunStatus& status) {
  if (status.chains.empty() || !(status.draws_per_second > 0)) return std::nullopt;
  const auto behind = std::ranges::min_element(status.chains, {}, &ChainStatus::iteration);
  const double left = std::max(0.0, steps - static_cast<double>(behind->iteration));
  return left * static_cast<double>(status.chains.size()) / status.draws_per_second;
}

/// How many times the draws that were judged it takes to reach what the rules ask: effective draws grow with
/// the draws, and the excess of R-hat over 1 falls as they grow, once chains have found each other.
std::optional<double> growth_to_goal(const StopRules& rules, const StopEvidence& evidence) {
  if (evidence.least_ess_of.empty() || !(evidence.least_ess >= kLeastEss)) return std::nullopt;
  if (!(evidence.largest_rhat < kUsableRhat)) return std::nullopt;
  double growth = rules.ess > 0 ? rules.ess / evidence.least_ess : 0;
  if (rules.rhat > 1) growth = std::max(growth, (evidence.largest_rhat - 1) / (rules.rhat - 1));
  return growth < kFurthestGuess ? std::optional(growth) : std::nullopt;
}

double steps_made(const RunStatus& status) {
  double steps = 0;
  for (const ChainStatus& chain : status.chains) steps += static_cast<double>(chain.iteration);
  return status.chains.empty() ? 0 : steps / static_cast<double>(status.chains.size());
}

void note(RunOutlook& outlook, RunOutlook::End end, std::optional<double> seconds) {
  if (!seconds || (outlook.seconds && *outlook.seconds <= *seconds)) return;
  outlook.seconds = std::max(0.0, *seconds);
  outlook.end = end;
}

void note_time(RunOutlook& outlook, const StopRules& rules, std::optional<double> spent) {
  if (rules.minutes > 0 && spent) note(outlook, RunOutlook::End::time, 60 * rules.minutes - *spent);
}

RunOutlook outlook_of_sampling(const RunStatus& status, const RunSettings& settings,
                               const std::optional<StopEvidence>& evidence, std::optional<double> spent) {
  const StopRules& rules = settings.stop;
  const double draws = std::max(0.0, steps_made(status) - settings.warmup.value());
  RunOutlook outlook;
  note(outlook, RunOutlook::End::draws, seconds_to(settings.warmup.value() + settings.draws, status));
  note_time(outlook, rules, spent);
  outlook.done = static_cast<float>(draws / std::max(1, settings.draws));
  if (rules.minutes > 0 && spent)
    outlook.done = std::max(outlook.done, static_cast<float>(*spent / (60 * rules.minutes)));
  if (rules.ask_for_quality()) {
    const auto growth = evidence ? growth_to_goal(rules, *evidence) : std::nullopt;
    outlook.at_most = !growth;
    if (growth) {
      const double judged = static_cast<double>(evidence->draws) / static_cast<double>(settings.chains);
      note(outlook, RunOutlook::End::goal, seconds_to(settings.warmup.value() + *growth * judged, status));
      outlook.done = std::max(outlook.done, static_cast<float>(draws / std::max(1.0, *growth * judged)));
    }
  }
  outlook.done = std::clamp(outlook.done, 0.0f, 1.0f);
  return outlook;
}

}  // namespace

RunOutlook run_outlook(const RunStatus& status, const RunSettings& settings,
                       const std::optional<StopEvidence>& evidence, std::optional<double> spent) {
  RunOutlook outlook;
  outlook.at_most = true;
  switch (status.phase) {
    case RunPhase::starting:
    case RunPhase::searching:
      outlook.done = static_cast<float>(std::clamp(status.search_fraction, 0.0, 1.0));
      note_time(outlook, settings.stop, spent);
      return outlook;
    case RunPhase::warming_up:
      outlook.done =
          static_cast<float>(std::clamp(steps_made(status) / std::max(1, settings.warmup.value()), 0.0, 1.0));
      note_time(outlook, settings.stop, spent);
      if (const auto seconds = seconds_to(settings.warmup.value(), status);
          seconds && !(outlook.seconds && *outlook.seconds < *seconds))
        return {outlook.done, seconds, RunOutlook::End::warmup, false};
      return outlook;
    case RunPhase::sampling:
    case RunPhase::paused:
      return outlook_of_sampling(status, settings, evidence, spent);
    case RunPhase::finished:
      outlook.done = 1;
      return outlook;
    default:
      outlook.done = outlook_of_sampling(status, settings, evidence, std::nullopt).done;
      return outlook;
  }
}

std::string outlook_text(const RunOutlook& outlook) {
  if (!outlook.seconds) return "How long it takes shows once draws come";
  const std::string time = duration_text(*outlook.seconds);
  if (outlook.end == RunOutlook::End::warmup) return "Warm-up takes " + time + " more; then draws count";
  if (outlook.at_most) {
    const std::string bare = time.starts_with("about ") ? time.substr(6) : time;
    return "At most " + bare + " to go";
  }
  const std::string begin = sentence(time) + " to go, until ";
  switch (outlook.end) {
    case RunOutlook::End::goal:
      return begin + "the draws are good enough";
    case RunOutlook::End::time:
      return begin + "its time is over";
    default:
      return begin + "all draws are made";
  }
}

std::string duration_text(double seconds) {
  const auto about = [](double count, const char* unit) {
    const auto whole = static_cast<long long>(std::max(1.0, std::round(count)));
    return "about " + std::to_string(whole) + " " + unit + (whole == 1 ? "" : "s");
  };
  if (!(seconds > 8)) return "a few seconds";
  if (seconds < 55) return about(10 * std::max(1.0, std::round(seconds / 10)), "second");
  if (seconds < 55 * 60.0) return about(seconds / 60, "minute");
  return about(seconds / 3600, "hour");
}

std::string agreement_text(const StopEvidence& evidence) {
  if (evidence.least_ess_of.empty()) return "Too few draws to say whether the chains agree";
  const double rhat = evidence.largest_rhat;
  const char* agree = rhat <= kGoodRhat    ? "Chains agree"
                      : rhat < kUsableRhat ? "Chains nearly agree"
                                           : "Chains do not agree yet";
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s (R-hat %.2f): %.0f independent draws", agree, rhat,
                std::floor(evidence.least_ess));
  return text.data();
}

}  // namespace patina
