#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/plugin/loader.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

struct PluginsOptions {
  fs::path probe;
  bool json = false;
};

std::map<fs::path, std::vector<const ComponentEntry*>> by_library(const Registry& registry) {
  std::map<fs::path, std::vector<const ComponentEntry*>> libraries;
  for (const ComponentEntry* entry : registry.all()) libraries[entry->library].push_back(entry);
  return libraries;
}

nlohmann::json to_json(const Registry& registry) {
  nlohmann::json out = {{"plaza", 1},
                        {"libraries", nlohmann::json::array()},
                        {"refused", nlohmann::json::array()},
                        {"searched", nlohmann::json::array()}};
  for (const auto& [library, entries] : by_library(registry)) {
    nlohmann::json components = nlohmann::json::array();
    for (const ComponentEntry* entry : entries) {
      const ComponentDeclaration& d = entry->declaration;
      components.push_back({{"name", d.name}, {"kind", d.kind}, {"summary", d.summary}});
    }
    out["libraries"].push_back({{"library", library.string()}, {"components", components}});
  }
  for (const RefusedPlugin& r : registry.refused()) {
    out["refused"].push_back(
        {{"library", r.library.string()}, {"reason", r.reason}, {"provides", r.provides}});
  }
  for (const fs::path& folder : registry.searched()) {
    out["searched"].push_back({{"folder", folder.string()}, {"exists", fs::is_directory(folder)}});
  }
  return out;
}

void print(const Registry& registry) {
  std::size_t kind_width = 0, name_width = 0;
  for (const ComponentEntry* entry : registry.all()) {
    kind_width = std::max(kind_width, entry->declaration.kind.size());
    name_width = std::max(name_width, entry->declaration.name.size());
  }
  const auto padded = [](std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
  };
  for (const auto& [library, entries] : by_library(registry)) {
    std::cout << library.string() << '\n';
    for (const ComponentEntry* entry : entries) {
      const ComponentDeclaration& d = entry->declaration;
      std::cout << "  " << padded(d.kind, kind_width) << "  " << padded(d.name, name_width) << "  "
                << d.summary << '\n';
    }
  }
  if (registry.all().empty()) std::cout << "no plugin was loaded\n";
  if (!registry.refused().empty()) std::cout << "\nrefused:\n";
  for (const RefusedPlugin& r : registry.refused()) {
    std::cout << "  " << r.library.string() << '\n' << "    " << r.reason << '\n';
  }
  std::cout << "\nsearched, in this order:\n";
  for (const fs::path& folder : registry.searched()) {
    std::cout << "  " << folder.string() << (fs::is_directory(folder) ? "" : "  (does not exist)")
              << '\n';
  }
}

int probe(const PluginsOptions& options) {
  const ProbeResult result = probe_plugin(options.probe);
  if (options.json) {
    std::cout << nlohmann::json{{"plaza", 1},
                                {"library", options.probe.string()},
                                {"usable", result.usable},
                                {"report", result.report}}
                     .dump(2)
              << '\n';
  } else {
    std::cout << options.probe.string() << ": " << (result.usable ? "usable: " : "")
              << result.report << '\n';
  }
  return result.usable ? kExitDone : kExitUserError;
}

}  // namespace

void add_plugins_command(CLI::App& app, CliContext& context) {
  CLI::App* command = app.add_subcommand(
      "plugins", "List plugin libraries, what they provide, and why some are refused");
  const auto options = std::make_shared<PluginsOptions>();
  command
      ->add_option(
          "--probe", options->probe,
          "Load one library in a process of its own and report on it; exit status 2 when it "
          "can't be used")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &context] {
    if (!options->probe.empty()) {
      context.exit_status = probe(*options);
      return;
    }
    // not the context's registry: this command must survive what ends the others
    Registry registry;
    survey_plugins(plugin_search_path(context.plugin_paths), registry);
    if (options->json) {
      std::cout << to_json(registry).dump(2) << '\n';
    } else {
      print(registry);
    }
  });
}

}  // namespace plaza
