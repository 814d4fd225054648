#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/component/declaration.h"

namespace plaza {

/// A component that can be made, and the library it came from.
struct ComponentEntry {
  ComponentDeclaration declaration;
  ComponentFactory factory;
  std::filesystem::path library;  ///< canonical path; empty: registered by the program itself
  std::shared_ptr<const void> library_handle;  ///< keeps the code loaded; may be null

  /// Makes the component. The returned pointer's deleter holds the library.
  std::shared_ptr<Component> create(const nlohmann::json& values,
                                    const BuildContext& context) const;
};

/// A library that was found but not used.
struct RefusedPlugin {
  std::filesystem::path library;
  std::string reason;  ///< found, wanted, and what to rebuild
  /// Names that the library is known or presumed to provide (plaza_NAME.so: NAME).
  std::vector<std::string> provides;
};

/// All components of a process. Filled once at the start, then read-only.
class Registry {
 public:
  /// Throws UserError naming both libraries when the name is taken; invalid names and kinds are
  /// refused.
  void add(ComponentEntry entry);
  /// Adds the components of one library: all of them, or none when one of them can't be added.
  void add_all(std::vector<ComponentEntry> entries);
  /// A library that is refused already (found through a link, too) is not recorded again.
  void add_refused(RefusedPlugin refused);
  void add_searched(std::filesystem::path directory);

  const ComponentEntry* find(std::string_view name) const;
  /// By name; all kinds when `kind` is empty.
  std::vector<const ComponentEntry*> all(std::string_view kind = {}) const;
  bool has_library(const std::filesystem::path& canonical) const;
  /// The library in use that has this file name.
  std::optional<std::filesystem::path> library_named(const std::filesystem::path& file_name) const;
  const std::vector<RefusedPlugin>& refused() const { return refused_; }
  const std::vector<std::filesystem::path>& searched() const { return searched_; }

  /// Why `name` can't be used as a component of `kind` (any kind when empty): the nearest name, the
  /// kind it has instead, or the library that would have provided it and why it was refused. Never
  /// an empty list.
  std::string explain_missing(std::string_view name, std::string_view kind) const;

 private:
  void check_addable(const ComponentEntry& entry) const;

  std::map<std::string, ComponentEntry, std::less<>> entries_;
  std::vector<RefusedPlugin> refused_;
  std::vector<std::filesystem::path> searched_;
};

}  // namespace plaza
