#include <CLI/CLI.hpp>

#include "framework/cli/commands.h"

namespace plaza {

void add_set_option(CLI::App& command, std::vector<std::string>& sets) {
  command
      .add_option(
          "--set", sets,
          "Set a value, e.g. /nodes/edges/sigma_px=2.5 (node by name or index); may be repeated")
      ->allow_extra_args(false)  // else what follows a value would be taken for a second one
      ->type_name("POINTER=VALUE");
}

}  // namespace plaza
