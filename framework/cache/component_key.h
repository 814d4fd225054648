#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "framework/execution/plan.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// Hashes of plugin libraries, each file read once.
class LibraryIdentities {
 public:
  /// A plugin's code, all of it: another build of the same plugin may compute something else.
  const std::string& of(const std::filesystem::path& library);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

/// Everything about a component that changes what it computes: name, library, parameters (paths
/// absolute), the identity of files that they name, and the same of its parts.
nlohmann::json component_key(const ResolvedPart& part, LibraryIdentities& libraries);

/// component_key() of a node, its wiring by the names of the nodes it reads, and, of a source, what
/// it says of its content.
nlohmann::json node_key(const ExecutionPlan& plan, std::size_t index, LibraryIdentities& libraries);

/// Node `index` and all nodes that it reads from, directly or not.
std::set<std::size_t> nodes_above(const ExecutionPlan& plan, std::size_t index);

/// Text of everything in a scene that changes what a node computes.
std::string scene_fingerprint(const Scene& scene);

/// What tells a file's content without reading all of it: size, time of modification and a hash of
/// both ends; of a folder its entries; "absent" otherwise.
std::string file_identity(const std::filesystem::path& file);

}  // namespace plaza
