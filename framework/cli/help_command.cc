#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/program.h"
#include "framework/config/text.h"
#include "plaza/core/error.h"

namespace plaza {

void add_help_command(CLI::App& app, CliContext& /*context*/) {
  CLI::App* command = app.add_subcommand("help", "Explain the program or one of its commands");
  const auto topic = std::make_shared<std::string>();
  command->add_option("COMMAND", *topic, "the command to explain");
  command->callback([&app, topic] {
    if (topic->empty()) {
      // not app.help(): while a command runs, that is the command's help
      std::cout << app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
      return;
    }
    for (const CLI::App* known : app.get_subcommands({})) {
      if (known->get_name() == *topic) {
        std::cout << known->help(app.get_name());
        return;
      }
    }
    throw UserError("unknown command \"" + *topic + "\"" +
                    did_you_mean(*topic, command_names(app)));
  });
}

}  // namespace plaza
