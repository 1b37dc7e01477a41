#include "gui/alarm_words.h"

#include <array>
#include <string_view>
#include <utility>

namespace patina {
namespace {

using Wording = std::pair<std::string_view, std::string_view>;

/// In this order: the last is what is left.
constexpr std::array<Wording, 5> kWordings{{
    {"(--errors averaged)", "(Rules..., averaged over irregularities)"},
    {"(--errors calibrated)", "(Rules..., learnt from simulated photos)"},
    {"(--errors paper)", "(Rules..., as usual between renders and photos)"},
    {" (--prior)", ""},  // the parameters' own curves are there to be dragged
    {"(--", "(patina-cli fit --"},
}};

}  // namespace

std::string by_controls(std::string sentence) {
  for (const auto& [option, control] : kWordings)
    for (std::size_t at = 0; (at = sentence.find(option, at)) != std::string::npos; at += control.size())
      sentence.replace(at, option.size(), control);
  return sentence;
}

}  // namespace patina
