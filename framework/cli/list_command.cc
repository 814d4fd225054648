#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/config/text.h"
#include "plaza/component/declaration.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

void require_kind(const std::string& kind) {
  const std::vector<std::string>& kinds = component_kinds();
  if (kind.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  const std::string hint = did_you_mean(kind, kinds);
  throw UserError("unknown kind " + quote(kind) +
                  (hint.empty() ? "; there are " + quote_all(kinds) : hint));
}

void list(const std::string& kind, const Registry& registry) {
  require_kind(kind);
  std::size_t width = 0;
  for (const ComponentEntry* entry : registry.all(kind))
    width = std::max(width, entry->declaration.name.size());
  bool any = false;
  for (const std::string& each : component_kinds()) {
    const std::vector<const ComponentEntry*> entries = registry.all(each);
    if ((!kind.empty() && each != kind) || entries.empty()) continue;
    std::cout << (any ? "\n" : "") << each << '\n';
    any = true;
    for (const ComponentEntry* entry : entries) {
      std::string name = entry->declaration.name;
      name.resize(width, ' ');
      std::cout << "  " << name << "  " << entry->declaration.summary << '\n';
    }
  }
  if (!any)
    std::cout << "no library that was loaded provides "
              << (kind.empty() ? "a component" : a_or_an(kind)) << '\n';
  for (const RefusedPlugin& refused : registry.refused()) {
    std::cerr << "plaza: note: " << refused.library.string()
              << " was refused (see: plaza plugins)\n";
  }
}

}  // namespace

void add_list_command(CLI::App& app, CliContext& context) {
  CLI::App* command = app.add_subcommand("list", "List the components there are, by kind");
  const auto kind = std::make_shared<std::string>();
  command->add_option("KIND", *kind, "Only of this kind: source, detector, affinity, ...");
  command->footer("Everything about one of them: plaza show COMPONENT");
  command->callback([kind, &context] { list(*kind, context.registry()); });
}

}  // namespace plaza
