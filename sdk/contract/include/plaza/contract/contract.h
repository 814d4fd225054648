#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plaza/component/declaration.h"
#include "plaza/contract/world.h"

namespace plaza::contract {

/// A component under test: what it declares and how to make one.
struct Subject {
  ComponentDeclaration declaration;
  std::function<std::shared_ptr<Component>(const nlohmann::json& values, const BuildContext&)> make;
};

/// The subject of a component class, without a plugin around it.
template <class C>
Subject subject_of() {
  const auto declaration = C::declare();
  return {
      declaration.info(kind_of<C>()),
      [parameters = declaration.parameters()](
          const nlohmann::json& values, const BuildContext& context) -> std::shared_ptr<Component> {
        return std::make_shared<C>(parameters.read(values), context);
      }};
}

/// Finds the components that stand inside another one, by the name after "use".
using Finder = std::function<std::optional<Subject>(const std::string& name)>;

/// How a component is to be tried.
struct Trial {
  std::string label = "defaults";
  /// Its parameters as a pipeline would give them; what is absent has its default. Parts are
  /// objects { "use": NAME, ... }, made with `finder`; input lists are arrays of { "from": ...,
  /// fields }. A modality that `finder` knows by the name after "from" is made, taught, and
  /// prepares the evidence that arrives there.
  nlohmann::json values = nlohmann::json::object();
  std::shared_ptr<const World> world = std::make_shared<World>();
  /// The scene that the component is told; the world's own when null (sources read files of their
  /// own).
  std::shared_ptr<const Scene> scene;
  Finder finder;
  /// Affinity terms only: describers { "use": NAME, parameters } that the world's observations go
  /// through before the term compares them, so that its cue is there; made with `finder`.
  std::vector<nlohmann::json> describers;
  SourceRole role = SourceRole::kClock;  ///< sources only
  /// Folder for what sinks and renderers write; emptied. A temporary one when empty.
  std::filesystem::path output_folder;
};

/// Everything in which a component breaks the written contract of its kind, one sentence each;
/// empty when it keeps it. What each kind promises is written in plaza/component/<kind>.h.
std::vector<std::string> violations(const Subject& subject, const Trial& trial = {});

/// Only what can be said of the declaration, without making the component.
std::vector<std::string> declaration_violations(const ComponentDeclaration& declaration);

}  // namespace plaza::contract
