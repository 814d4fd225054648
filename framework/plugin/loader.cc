#include "framework/plugin/loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>
// library_info.hpp of Boost.DLL 1.74 needs <vector> and <string> included before it; the standard
// file system saves linking Boost's own.
#define BOOST_DLL_USE_STD_FS
#include <boost/dll/shared_library.hpp>

#include "framework/plugin/abi.h"
#include "plaza/core/error.h"

namespace plaza {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPrefix = "plaza_";

/// Why a library is not used.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class CollectingRegistrar final : public ComponentRegistrar {
 public:
  CollectingRegistrar(fs::path library, std::shared_ptr<const void> handle)
      : library_(std::move(library)), handle_(std::move(handle)) {}
  std::vector<ComponentEntry> take() { return std::move(entries_); }

 protected:
  void do_add(ComponentDeclaration declaration, ComponentFactory factory) override {
    entries_.push_back({std::move(declaration), std::move(factory), library_, handle_});
  }

 private:
  fs::path library_;
  std::shared_ptr<const void> handle_;
  std::vector<ComponentEntry> entries_;
};

/// What can be said of a file without opening it as a library.
void check_file(const fs::path& library) {
  std::error_code error;
  const fs::file_status status = fs::status(library, error);
  if (fs::is_directory(status)) throw Refusal("is a folder, not a library");
  if (!fs::is_regular_file(status)) {
    throw Refusal("can't be read: " + (error ? error.message() : "not a regular file"));
  }
  std::ifstream in(library, std::ios::binary);
  if (!in) throw Refusal("can't be read: " + std::generic_category().message(errno));
  std::array<char, 4> start{};
  in.read(start.data(), start.size());
  if (in.gcount() == 0) throw Refusal("is an empty file; build or copy it again");
  if (std::string_view(start.data(), start.size()) !=
      "\x7f"
      "ELF") {
    throw Refusal("is not an ELF shared library; build or copy it again");
  }
  // before the loader runs the library's static initialisers, or stumbles over symbols that another
  // version of the SDK had
  const std::vector<PluginDescriptor> descriptors = descriptors_in_file(library);
  std::string first_mismatch;
  for (const PluginDescriptor& descriptor : descriptors) {
    const std::string mismatch = descriptor_mismatch(descriptor);
    if (mismatch.empty()) return;
    if (first_mismatch.empty()) first_mismatch = mismatch;
  }
  if (!first_mismatch.empty()) throw Refusal(first_mismatch);
}

using LibraryHandle = std::shared_ptr<const boost::dll::shared_library>;

/// Opens a library for the rest of the process's life: objects, exceptions and type information of
/// a plugin may outlive every reference that we know of.
LibraryHandle open_for_good(const fs::path& canonical) {
  static auto& opened = *new std::map<fs::path, LibraryHandle>;
  LibraryHandle& handle = opened[canonical];
  if (handle) return handle;
  auto library = std::make_shared<boost::dll::shared_library>();
  std::error_code error;
  // now: a symbol that is missing is found here, not as the end of the process at its first call.
  // local: two plugins may define the same names.
  library->load(canonical, error,
                boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
  if (error) {
    const char* text = dlerror();  // Boost keeps only a code that says less
    throw Refusal("can't be loaded: " + (text != nullptr ? std::string(text) : error.message()));
  }
  handle = std::move(library);
  return handle;
}

std::vector<ComponentEntry> components_of(const fs::path& canonical) {
  check_file(canonical);
  const LibraryHandle library = open_for_good(canonical);
  if (!library->has(kPluginSymbol)) {
    throw Refusal("has no entry: the symbol " + std::string(kPluginSymbol) +
                  " is missing; define it with PLAZA_PLUGIN(registrar) { ... } of plaza/plugin.h");
  }
  const auto& descriptor = library->get<const PluginDescriptor>(kPluginSymbol);
  if (const std::string mismatch = descriptor_mismatch(descriptor); !mismatch.empty()) {
    throw Refusal(mismatch);
  }
  if (descriptor.register_components == nullptr)
    throw Refusal("its descriptor has no register function");
  CollectingRegistrar registrar(canonical, library);
  try {
    descriptor.register_components(static_cast<ComponentRegistrar*>(&registrar));
  } catch (const std::exception& error) {
    throw Refusal("failed to register its components: " + std::string(error.what()));
  } catch (...) {
    throw Refusal("failed to register its components: threw something that is no std::exception");
  }
  std::vector<ComponentEntry> entries = registrar.take();
  if (entries.empty()) {
    throw Refusal("registers no component; call registrar.add<...>() inside PLAZA_PLUGIN");
  }
  return entries;
}

}  // namespace

std::vector<std::string> presumed_components(const fs::path& library) {
  std::string name = library.stem().string();
  if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
  std::replace(name.begin(), name.end(), '_', '-');
  return {name};
}

void load_plugin(const fs::path& library, Registry& registry) {
  std::error_code error;
  fs::path canonical = fs::canonical(library, error);
  if (error) {
    registry.add_refused(
        {library, "can't be read: " + error.message(), presumed_components(library)});
    return;
  }
  std::vector<std::string> names = presumed_components(library);
  try {
    if (registry.has_library(canonical)) return;
    if (const std::optional<fs::path> first = registry.library_named(canonical.filename())) {
      throw Refusal("is hidden by " + first->string() + ", which was found first");
    }
    std::vector<ComponentEntry> entries = components_of(canonical);
    names.clear();
    for (const ComponentEntry& entry : entries) names.push_back(entry.declaration.name);
    registry.add_all(std::move(entries));
  } catch (const Refusal& refusal) {
    registry.add_refused({canonical, refusal.what(), names});
  } catch (const UserError& error) {
    registry.add_refused({canonical, error.what(), names});
  }
}

void load_plugins(const std::vector<fs::path>& folders, Registry& registry) {
  for (const fs::path& folder : folders) registry.add_searched(folder);
  for (const fs::path& library : find_plugins(folders)) load_plugin(library, registry);
  note_left_out(folders, registry);
}

}  // namespace plaza
