#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "framework/cache/cache_folder.h"
#include "framework/cache/node_cache.h"
#include "framework/cli/commands.h"
#include "framework/cli/context.h"
#include "framework/results/number_text.h"
#include "framework/study/report/tables.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

struct CacheArguments {
  std::string folder;
  bool clear = false;
  std::string use;
  std::optional<double> limit_gb;
};

struct Sum {
  std::size_t entries = 0;
  std::uintmax_t bytes = 0;
  double seconds = 0;
};

/// What stands in the table's first column: the component, or what else it is.
std::string group_of(const CachedFile& file) {
  if (file.learned) return "(learned models)";
  if (!file.info) return "(damaged)";
  return file.info->declined ? "(not worth keeping)" : file.info->use;
}

void show(const NodeCache& cache, const std::filesystem::path& folder) {
  std::map<std::string, Sum> groups;
  Sum all;
  for (const CachedFile& file : cache.list()) {
    Sum& sum = groups[group_of(file)];
    for (Sum* s : {&sum, &all}) {
      ++s->entries;
      s->bytes += file.bytes;
      if (!file.info || file.info->declined) continue;
      const auto own = file.info->seconds.find(file.info->node);
      if (own != file.info->seconds.end()) s->seconds += own->second;
    }
  }
  constexpr int kDecimals = 1;
  WordTable table;
  table.title = folder.string() + ", at most " + size_text(cache.limit_bytes());
  table.head = {"component", "entries", "size", "computed in"};
  table.left = 1;
  const auto add = [&table](const std::string& name, const Sum& sum) {
    table.rows.push_back({name, std::to_string(sum.entries), size_text(sum.bytes),
                          fixed_text(sum.seconds, kDecimals) + " s"});
  };
  for (const auto& [name, sum] : groups) add(name, sum);
  add("together", all);
  std::cout << to_text(table);
}

void run(const CacheArguments& arguments) {
  const std::filesystem::path folder =
      arguments.folder.empty() ? default_cache_folder() : std::filesystem::path(arguments.folder);
  constexpr double kBytesPerGb = 1e9;
  const std::uintmax_t limit = arguments.limit_gb
                                   ? static_cast<std::uintmax_t>(*arguments.limit_gb * kBytesPerGb)
                                   : default_cache_limit(folder);
  const NodeCache cache(folder, limit);
  if (!arguments.use.empty() && !arguments.clear) {
    throw UserError("a component is for --clear; without it the whole cache is shown");
  }
  if (arguments.clear) {
    std::cout << "removed " << cache.clear(arguments.use) << " entries\n";
    return;
  }
  if (arguments.limit_gb) std::cout << "freed " << size_text(cache.make_room()) << '\n';
  show(cache, folder);
}

}  // namespace

void add_cache_command(CLI::App& app, CliContext& /*context*/) {
  CLI::App* command =
      app.add_subcommand("cache", "Show or clear what earlier runs of studies computed");
  const auto arguments = std::make_shared<CacheArguments>();
  command->add_option("COMPONENT", arguments->use, "With --clear: only what this component gave");
  command->add_flag("--clear", arguments->clear,
                    "Remove everything, learned models too; running studies only lose time");
  command
      ->add_option("--limit", arguments->limit_gb,
                   "Remove what was used longest ago until the rest is no larger than this")
      ->check(CLI::NonNegativeNumber)
      ->type_name("GB");
  command
      ->add_option("--cache-dir", arguments->folder,
                   "The cache; default: $XDG_CACHE_HOME/plaza or ~/.cache/plaza")
      ->type_name("DIR");
  command->footer(
      "Entries belong to everything they were computed from (parameters, data, plugins), so "
      "nothing "
      "in\nthe cache is ever out of date, only unused.");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace plaza
