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
  add_set_option(*command, arguments->sets);
  command->footer("For a picture: plaza graph PIPELINE | dot -Tsvg -o pipeline.svg");
  command->callback([arguments, &context] {
    std::cout << graph_dot(read_pipeline({arguments->file, arguments->sets}, context.registry()));
  });
}

}  // namespace plaza
