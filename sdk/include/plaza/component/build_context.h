#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/component/component.h"
#include "plaza/core/error.h"
#include "plaza/geometry/scene.h"

namespace plaza {

/// A nested component with the name it has in the pipeline.
struct NamedPart {
  std::string name;
  std::shared_ptr<Component> component;
};

/// One entry of an input list: the slot to pass to NodeIo::in(), the node that fills it (a detector
/// calls its modality's sample and match), and the entry's own fields.
struct InputReference {
  std::size_t slot = 0;
  std::string from;
  std::shared_ptr<Component> producer;
  nlohmann::json fields;
};

/// What the kernel hands to a component's constructor beside its options.
class PLAZA_API BuildContext {
 public:
  std::string name;                    ///< of this node or part, unique in the pipeline
  std::shared_ptr<const Scene> scene;  ///< never null
  std::uint64_t seed = 0;              ///< from the pipeline's seed and this component's name
  std::filesystem::path
      output_folder;  ///< where sinks and renderers write; exists when a run starts
  /// Whether frames come in order, one at a time (Declaration::memory): what a component may keep
  /// from one call to the next depends on it.
  bool in_order = false;
  std::map<std::string, std::vector<NamedPart>> part_lists;  ///< by parameter; kPart has one entry
  std::map<std::string, std::vector<InputReference>> input_lists;

  /// The nested component of parameter `parameter`; throws InternalError when it is no T.
  template <class T>
  std::shared_ptr<T> part(const std::string& parameter) const {
    return cast<T>(only_part(parameter), parameter);
  }
  template <class T>
  std::vector<std::shared_ptr<T>> parts(const std::string& parameter) const {
    std::vector<std::shared_ptr<T>> out;
    for (const NamedPart& p : all_parts(parameter)) out.push_back(cast<T>(p, parameter));
    return out;
  }
  const std::vector<InputReference>& inputs(const std::string& parameter) const;
  const std::vector<NamedPart>& all_parts(const std::string& parameter) const;

 private:
  const NamedPart& only_part(const std::string& parameter) const;
  template <class T>
  static std::shared_ptr<T> cast(const NamedPart& p, const std::string& parameter) {
    auto typed = std::dynamic_pointer_cast<T>(p.component);
    if (!typed)
      throw InternalError("part '" + p.name + "' of parameter '" + parameter +
                          "' has another kind");
    return typed;
  }
};

}  // namespace plaza
