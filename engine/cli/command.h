#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace patina {

constexpr int kDone = 0;       ///< exit status
constexpr int kRunFailed = 1;  ///< the reason is on stderr, what was drawn is kept
constexpr int kBadInput = 2;   ///< bad usage or unreadable input: one line on stderr says what to do

/// The command that the arguments chose; returns the exit status. @throws UserError for bad input
using Command = std::function<int()>;

// Each adds one sub-command; parsing it sets `chosen`.
void add_fit(CLI::App& app, Command& chosen);
void add_predict(CLI::App& app, Command& chosen);
void add_render(CLI::App& app, Command& chosen);
void add_summarize(CLI::App& app, Command& chosen);
void add_export(CLI::App& app, Command& chosen);
void add_materials(CLI::App& app, Command& chosen);
void add_chart(CLI::App& app, Command& chosen);
void add_calibrate(CLI::App& app, Command& chosen);
void add_stress(CLI::App& app, Command& chosen);
void add_compare(CLI::App& app, Command& chosen);

}  // namespace patina
