#include <exception>
#include <utility>

#include "framework/config/pipeline.h"
#include "framework/config/text.h"
#include "plaza/component/node.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::uint64_t kFnvOffset = 14695981039346656037U;
constexpr std::uint64_t kFnvPrime = 1099511628211U;

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = kFnvOffset;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kFnvPrime;
  return hash;
}

/// Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014).
std::uint64_t splitmix64(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// Position of the value at `pointer` below the part, or of its nearest written ancestor.
FilePosition position_of(const ResolvedPart& part, std::string_view pointer) {
  while (!pointer.empty()) {
    const auto it = part.origins.find(pointer);
    if (it != part.origins.end() && !it->second.where.file.empty()) return it->second.where;
    const auto slash = pointer.rfind('/');
    if (slash == std::string_view::npos) break;
    pointer = pointer.substr(0, slash);
  }
  return part.where;
}

/// The pointer in the file where the value was written; below the component where it was not.
std::string pointer_of(const ResolvedPart& part, const std::string& pointer) {
  const auto it = part.origins.find(pointer);
  return it != part.origins.end() ? it->second.pointer : part.pointer + pointer;
}

class Assembler {
 public:
  Assembler(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
            const std::filesystem::path& output_folder)
      : pipeline_(pipeline), scene_(std::move(scene)), output_folder_(output_folder) {}

  Assembly run() {
    Assembly assembly;
    assembly.scene = scene_;
    for (const ResolvedNode& node : pipeline_.nodes) {
      assembly.nodes.push_back(make_node(node, assembly.nodes));
    }
    if (!diagnostics_.empty()) throw UserError(diagnostics_);
    return assembly;
  }

 private:
  BuildContext context_of(const ResolvedPart& part) const {
    BuildContext context;
    context.name = part.name;
    context.scene = scene_;
    context.seed = component_seed(pipeline_.seed, part.path);
    context.output_folder = output_folder_;
    context.in_order = part.entry->declaration.memory;
    return context;
  }

  /// Null when it or one of its parts can't be made; why is among the diagnostics.
  std::shared_ptr<Component> make_node(const ResolvedNode& node,
                                       const std::vector<std::shared_ptr<Component>>& above) {
    BuildContext context = context_of(node);
    bool complete = true;
    for (const auto& [parameter, records] : node.input_lists) {
      std::vector<InputReference>& list = context.input_lists[parameter];
      for (const ResolvedInputRecord& record : records) {
        const auto producer = static_cast<std::size_t>(node.inputs.at(record.input).node);
        complete = complete && above.at(producer) != nullptr;
        list.push_back({record.input, record.from, above[producer], record.fields});
      }
    }
    std::shared_ptr<Component> component = make(node, std::move(context), complete);
    if (component && dynamic_cast<Node*>(component.get()) == nullptr) {
      throw InternalError(described(node) + " is no node");
    }
    return component;
  }

  std::shared_ptr<Component> make(const ResolvedPart& part, BuildContext context, bool complete) {
    for (const auto& [parameter, nested] : part.parts) {
      std::vector<NamedPart>& list = context.part_lists[parameter];
      for (const ResolvedPart& item : nested) {
        std::shared_ptr<Component> made = make(item, context_of(item), true);
        complete = complete && made != nullptr;
        list.push_back({item.name, std::move(made)});
      }
    }
    if (!complete) return nullptr;
    std::shared_ptr<Component> component;
    guard(part, [&] { component = part.entry->create(part.values, context); });
    if (component) {
      guard(part, [&] {
        for (Diagnostic& d : component->check()) add(part, std::move(d));
      });
    }
    return component;
  }

  static std::string described(const ResolvedPart& part) {
    std::string text = "component " + quote(part.path) + " (" + part.entry->declaration.name;
    if (!part.entry->library.empty()) text += " of " + part.entry->library.string();
    return text + ")";
  }

  /// Every call of a plugin's code: its user errors are collected, its other exceptions end the
  /// assembly.
  template <class Call>
  void guard(const ResolvedPart& part, const Call& call) {
    try {
      call();
    } catch (const UserError& error) {
      for (const Diagnostic& d : error.diagnostics()) add(part, d);
    } catch (Error& error) {
      FaultContext context;
      context.component = part.name;
      error.add_context(context);
      throw;
    } catch (const std::exception& error) {
      fail(part, error.what());
    } catch (...) {
      fail(part, "an exception that is no std::exception");
    }
  }

  [[noreturn]] static void fail(const ResolvedPart& part, const std::string& what) {
    InternalError error(described(part) + " failed: " + what);
    FaultContext context;
    context.component = part.name;
    error.add_context(context);
    throw error;
  }

  void add(const ResolvedPart& part, Diagnostic diagnostic) {
    // a component that read a file knows the place there better than we do
    if (diagnostic.where.file.empty()) diagnostic.where = position_of(part, diagnostic.pointer);
    diagnostic.pointer = pointer_of(part, diagnostic.pointer);
    diagnostics_.push_back(std::move(diagnostic));
  }

  const ResolvedPipeline& pipeline_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path output_folder_;
  Diagnostics diagnostics_;
};

}  // namespace

std::uint64_t component_seed(std::uint64_t pipeline_seed, std::string_view path) {
  return splitmix64(splitmix64(pipeline_seed) ^ fnv1a(path));
}

Assembly assemble(const ResolvedPipeline& pipeline, std::shared_ptr<const Scene> scene,
                  const std::filesystem::path& output_folder) {
  return Assembler(pipeline, std::move(scene), output_folder).run();
}

}  // namespace plaza
