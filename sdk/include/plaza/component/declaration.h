#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "plaza/component/affinity.h"
#include "plaza/component/associator.h"
#include "plaza/component/build_context.h"
#include "plaza/component/describer.h"
#include "plaza/component/detector.h"
#include "plaza/component/evaluator.h"
#include "plaza/component/modality.h"
#include "plaza/component/models.h"
#include "plaza/component/parameter.h"
#include "plaza/component/renderer.h"
#include "plaza/component/sink.h"
#include "plaza/component/source.h"
#include "plaza/data/feature.h"

namespace plaza {

/// A typed input or output of a node.
struct PortSpec {
  std::string type;      ///< the payload's kPort
  bool required = true;  ///< inputs only
  std::string meaning;
};

enum class Better { kHigher, kLower, kNeither };

/// A figure that an evaluator gives.
struct MetricSpec {
  std::string section;  ///< "tracking"
  std::string name;     ///< "MOTA"
  std::string unit;     ///< "" for ratios and counts, "m", "deg"
  Better better = Better::kHigher;
  std::string meaning;
  bool detail = false;  ///< true: in files and studies, but not in the table at a run's end
};

/// What the world may know of a component without making one.
struct ComponentDeclaration {
  std::string name;     ///< as in "use": lower case, digits, hyphens; unique among all plugins
  std::string kind;     ///< one of component_kinds()
  std::string summary;  ///< one sentence
  std::string source;   ///< thesis chapter, equation or paper
  std::vector<ParameterSpec> parameters;
  std::vector<PortSpec> inputs;
  std::vector<PortSpec> outputs;
  std::vector<MetricSpec> metrics;
  std::vector<FeatureSpec> features;  ///< that it adds to observations or tracklets
  bool memory = false;                ///< true: frames must be processed in order, one at a time
};

/// "source", "modality", "shape", "appearance", "motion", "detector", "describer", "affinity",
/// "associator", "evaluator", "sink", "renderer".
PLAZA_API const std::vector<std::string>& component_kinds();

/// The kind of a component class, from its base.
template <class C>
constexpr std::string_view kind_of() {
  if constexpr (std::is_base_of_v<Source, C>)
    return "source";
  else if constexpr (std::is_base_of_v<Modality, C>)
    return "modality";
  else if constexpr (std::is_base_of_v<ShapeModel, C>)
    return "shape";
  else if constexpr (std::is_base_of_v<AppearanceModel, C>)
    return "appearance";
  else if constexpr (std::is_base_of_v<MotionModel, C>)
    return "motion";
  else if constexpr (std::is_base_of_v<Detector, C>)
    return "detector";
  else if constexpr (std::is_base_of_v<Describer, C>)
    return "describer";
  else if constexpr (std::is_base_of_v<AffinityTerm, C>)
    return "affinity";
  else if constexpr (std::is_base_of_v<Associator, C>)
    return "associator";
  else if constexpr (std::is_base_of_v<Evaluator, C>)
    return "evaluator";
  else if constexpr (std::is_base_of_v<Renderer, C>)
    return "renderer";
  else if constexpr (std::is_base_of_v<Sink, C>)
    return "sink";
  else
    static_assert(!sizeof(C), "a component derives from one of the kinds in plaza/component/");
}

/// Kinds that see frames in order whatever the component says.
PLAZA_API bool kind_has_memory(std::string_view kind);

/// A component's declaration with its parameters bound to `Options`.
template <class Options>
class Declaration {
 public:
  Declaration(std::string name, std::string summary) {
    info_.name = std::move(name);
    info_.summary = std::move(summary);
  }
  Declaration& source(std::string text) {
    info_.source = std::move(text);
    return *this;
  }
  template <class T>
  Declaration& input(std::string meaning) {
    info_.inputs.push_back({std::string(T::kPort), true, std::move(meaning)});
    return *this;
  }
  template <class T>
  Declaration& optional_input(std::string meaning) {
    info_.inputs.push_back({std::string(T::kPort), false, std::move(meaning)});
    return *this;
  }
  template <class T>
  Declaration& output(std::string meaning) {
    info_.outputs.push_back({std::string(T::kPort), true, std::move(meaning)});
    return *this;
  }
  Declaration& metric(MetricSpec metric) {
    info_.metrics.push_back(std::move(metric));
    return *this;
  }
  /// Features of type F are among what it gives; all that it adds must be declared. Those with
  /// F::load() can be kept between runs, see Feature.
  template <class F>
  Declaration& feature(std::string meaning) {
    info_.features.push_back(feature_spec<F>(std::move(meaning)));
    return *this;
  }
  /// Frames must come in order (sources, associators, evaluators, sinks and renderers always do).
  Declaration& memory() {
    info_.memory = true;
    return *this;
  }
  Declaration& parameters(Parameters<Options> p) {
    parameters_ = std::move(p);
    return *this;
  }

  const Parameters<Options>& parameters() const { return parameters_; }
  ComponentDeclaration info(std::string_view kind) const {
    ComponentDeclaration out = info_;
    out.kind = kind;
    out.parameters = parameters_.specs();
    out.memory = out.memory || kind_has_memory(kind);
    return out;
  }

 private:
  ComponentDeclaration info_;
  Parameters<Options> parameters_;
};

/// Makes a component from validated parameter values (parts and inputs come through the context).
using ComponentFactory =
    std::function<std::unique_ptr<Component>(const nlohmann::json& values, const BuildContext&)>;

/// What a plugin's register function fills.
class PLAZA_API ComponentRegistrar {
 public:
  virtual ~ComponentRegistrar();

  /// Registers component class C with `struct C::Options`, `static Declaration<Options>
  /// C::declare()` and the constructor `C(const Options&, const BuildContext&)`.
  template <class C>
  void add() {
    const auto declaration = C::declare();
    do_add(declaration.info(kind_of<C>()),
           [parameters = declaration.parameters()](const nlohmann::json& values,
                                                   const BuildContext& context) {
             return std::make_unique<C>(parameters.read(values), context);
           });
  }

 protected:
  virtual void do_add(ComponentDeclaration declaration, ComponentFactory factory) = 0;
};

}  // namespace plaza
