#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/config/graph_dot.h"
#include "framework/config/pipeline.h"

namespace plaza {

void add_graph_command(CLI::App& app, CliContext& context) {
  struct Arguments {
    std::filesystem::path file;
    std::vector<std::string> sets;
  };
  CLI::App* command =
      app.add_subcommand("graph", "Print a pipeline as a graph in graphviz's DOT language");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("PIPELINE", arguments->file, "The pipeline's JSON file")->required();
  command
      ->add_option(
          "--set", arguments->sets,
          "Set a value, e.g. /nodes/edges/sigma_px=2.5 (node by name or index); may be repeated")
      ->allow_extra_args(false)
      ->type_name("POINTER=VALUE");
  command->footer("For a picture: plaza graph PIPELINE | dot -Tsvg -o pipeline.svg");
  command->callback([arguments, &context] {
    std::cout << graph_dot(read_pipeline({arguments->file, arguments->sets}, context.registry()));
  });
}

}  // namespace plaza
