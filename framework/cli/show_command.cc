#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/config/component_text.h"
#include "framework/config/schema.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

struct ShowArguments {
  std::string component;
  bool json = false;
  bool schema = false;
};

void show(const ShowArguments& arguments, const Registry& registry) {
  constexpr int kIndent = 2;
  if (arguments.schema) {
    if (!arguments.component.empty()) throw UserError("--schema is of all components; name none");
    std::cout << pipeline_schema(registry).dump(kIndent) << '\n';
    return;
  }
  if (arguments.component.empty()) {
    throw UserError("name a component (see: plaza list), or give --schema");
  }
  const ComponentEntry* entry = registry.find(arguments.component);
  if (entry == nullptr) throw UserError(registry.explain_missing(arguments.component, {}));
  if (arguments.json) {
    std::cout << component_json(*entry).dump(kIndent) << '\n';
  } else {
    std::cout << component_text(*entry);
  }
}

}  // namespace

void add_show_command(CLI::App& app, CliContext& context) {
  CLI::App* command = app.add_subcommand("show", "Show everything about a component");
  const auto arguments = std::make_shared<ShowArguments>();
  command->add_option("COMPONENT", arguments->component, "Its name, as in \"use\"");
  command->add_flag("--json", arguments->json, "For programs");
  command->add_flag("--schema", arguments->schema,
                    "Print the JSON Schema of pipelines, made from all components");
  command->footer(
      "For completion in an editor: plaza show --schema > pipeline.schema.json, and in the "
      "pipeline\n"
      "\"$schema\": \"pipeline.schema.json\"");
  command->callback([arguments, &context] { show(*arguments, context.registry()); });
}

}  // namespace plaza
