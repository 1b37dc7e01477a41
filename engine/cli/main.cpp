#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "engine/allocator.h"
#include "engine/cli/command.h"
#include "engine/error.h"
#include "engine/run/first_line.h"
#include "engine/run/version.h"

namespace patina {
namespace {

int refuse(const std::string& sentence, int status) {
  std::fprintf(stderr, "patina-cli: %s\n", first_line(sentence).c_str());
  return status;
}

std::string with_help(const char* what) { return first_line(what) + " (see patina-cli --help)"; }

int run(int argc, char** argv) {
  CLI::App app("Posterior draws of a procedural material that could have made a photo", "patina-cli");
  app.set_version_flag("--version", program_version(), "Print the version");
  app.require_subcommand(1);
  Command chosen;
  add_fit(app, chosen);
  add_predict(app, chosen);
  add_render(app, chosen);
  add_summarize(app, chosen);
  add_export(app, chosen);
  add_materials(app, chosen);
  add_chart(app, chosen);
  add_calibrate(app, chosen);
  add_stress(app, chosen);
  add_compare(app, chosen);
  try {
    app.parse(argc, argv);
    return chosen();
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::RequiredError& error) {
    const bool no_command = app.get_subcommands().empty();
    return refuse(no_command
                      ? "Name a command: fit, predict, compare, render, summarize, export, materials, chart, "
                        "calibrate or stress (see patina-cli --help)"
                      : with_help(error.what()),
                  kBadInput);
  } catch (const CLI::ParseError& error) {
    return refuse(with_help(error.what()), kBadInput);
  } catch (const UserError& error) {
    return refuse(error.what(), kBadInput);
  } catch (const std::exception& error) {
    return refuse(error.what(), kRunFailed);
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is a failed write, as a full disk is
  return patina::run(argc, argv);
}
