#include "framework/cli/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/config/text.h"
#include "plaza/core/error.h"
#include "plaza/version.h"

namespace plaza {
namespace {

constexpr const char* kDescription =
    "Plaza tracks people over several calibrated cameras: which people are where on the ground, "
    "which\n"
    "way they face, and who is who over time.";
constexpr const char* kFooter =
    "Exit status: 0 done, 2 the user's error, 3 internal error; an interrupted run 128 + the "
    "signal.";

void print_lines(std::ostream& out, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out << "plaza: " << line << '\n';
}

/// "plaza: node 'detector', frame 12: " before the message when the fault happened within a run.
void print_error(std::ostream& out, const Error& error) {
  const std::string place = to_string(error.context());
  print_lines(out, place.empty() ? error.what() : place + ": " + error.what());
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* level = &app; level != nullptr; level = level->get_parent()) {
    for (const CLI::Option* option : level->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  return names;
}

/// What CLI11 says of arguments that nobody takes names neither the command nor what was meant.
std::string explain_extras(const CLI::App& app) {
  const std::vector<const CLI::App*> parsed = [&app] {
    std::vector<const CLI::App*> commands;
    for (const CLI::App* command : app.get_subcommands()) commands.push_back(command);
    return commands;
  }();
  const std::vector<std::string> extras = app.remaining(true);
  const std::string word = extras.empty() ? "" : extras.front();
  const CLI::App& scope = parsed.empty() ? app : *parsed.front();
  const std::string of = parsed.empty() ? "" : " of \"plaza " + scope.get_name() + "\"";
  const std::string help = "\nsee: plaza help" + (parsed.empty() ? "" : " " + scope.get_name());
  if (word.starts_with("-")) {
    const std::string name = word.substr(0, word.find('='));
    return "unknown option \"" + name + "\"" + of + did_you_mean(name, option_names(scope)) + help;
  }
  if (parsed.empty()) {
    return "unknown command \"" + word + "\"" + did_you_mean(word, command_names(app)) + help;
  }
  return "unexpected argument \"" + word + "\"" + of + help;
}

void run_command_line(CLI::App& app, const std::vector<std::string>& arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // what CLI11 wants
  try {
    app.parse(std::move(reversed));
  } catch (const CLI::ExtrasError&) {
    throw UserError(explain_extras(app));
  } catch (const CLI::Success&) {
    throw;
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    throw UserError(std::string(error.what()) + "\nsee: plaza help" +
                    (parsed.empty() ? "" : " " + parsed.front()->get_name()));
  }
  if (app.get_subcommands().empty()) {
    throw UserError("no command given; see: plaza help");
  }
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

int run_program(const std::vector<std::string>& arguments, std::ostream& errors) {
  CliContext context;
  CLI::App app(kDescription, "plaza");
  app.footer(kFooter);
  app.set_version_flag("--version", "plaza " PLAZA_VERSION, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.require_subcommand(0, 1);  // at most one: "plaza help run" does not run
  app.fallthrough();             // options of the program may follow the command
  app.add_option("--plugin-path", context.plugin_paths,
                 "Folder to look for plugins in first; may be given several times")
      ->allow_extra_args(false)
      ->type_name("DIR");
#define PLAZA_COMMAND(name) add_##name##_command(app, context);
#include "plaza_commands.inc"
#undef PLAZA_COMMAND

  try {
    run_command_line(app, arguments);
    return context.exit_status;
  } catch (const CLI::Success& asked_for) {  // --help and --version
    return app.exit(asked_for, std::cout, errors);
  } catch (const UserError& error) {
    print_error(errors, error);
    return kExitUserError;
  } catch (const Error& error) {
    print_error(errors, error);
    errors << "plaza: this is a fault of Plaza or of a plugin, not yours\n";
    return kExitInternalError;
  } catch (const std::exception& error) {
    print_lines(errors, std::string("internal error: ") + error.what());
    return kExitInternalError;
  }
}

}  // namespace plaza
