#include "framework/cli/context.h"

#include "framework/plugin/loader.h"

namespace plaza {

const Registry& CliContext::registry() {
  if (!registry_) {
    // emplaced only when complete: a second call after an error must not find half a registry
    Registry registry;
    load_plugins(plugin_search_path(plugin_paths), registry);
    registry_.emplace(std::move(registry));
  }
  return *registry_;
}

}  // namespace plaza
