#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "findings.h"
#include "plaza/contract/contract.h"

namespace plaza::contract {

/// What arrives at an input of a type in a frame.
using Provider = std::function<PayloadPtr(const std::string& port, std::int64_t frame)>;
/// What arrives at an input of an input list, by its place among those; null: ask the Provider.
using ListProvider = std::function<PayloadPtr(std::size_t entry, std::int64_t frame)>;

/// One call of a node, with all that NodeIo points into.
class Call {
 public:
  Call(const ComponentDeclaration& declaration, const std::vector<std::string>& inputs,
       std::int64_t frame, std::int64_t time_ns, const Provider& provider,
       const ListProvider& list_provider, bool optional_inputs = true);
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  NodeIo& io() { return io_; }
  PayloadPtr output(std::size_t i) const { return slots_[static_cast<std::size_t>(outputs_[i])]; }
  std::size_t output_count() const { return outputs_.size(); }
  PayloadPtr input(std::size_t i) const {
    return inputs_[i] < 0 ? nullptr : slots_[static_cast<std::size_t>(inputs_[i])];
  }
  std::size_t input_count() const { return inputs_.size(); }
  /// All outputs as text.
  std::string digest_of_outputs() const;

 private:
  std::vector<PayloadPtr> slots_;
  std::vector<int> inputs_, outputs_;
  NodeIo io_;
};

/// Makes the component under test, with its parts, and calls it as the kernel does.
class Stage {
 public:
  Stage(const Subject& subject, const Trial& trial, std::filesystem::path output_folder);

  const ComponentDeclaration& declaration() const { return subject_->declaration; }
  const Trial& trial() const { return *trial_; }
  const World& world() const { return *trial_->world; }
  const Scene& scene() const { return *scene_; }
  const std::filesystem::path& output_folder() const { return output_folder_; }

  /// A fresh component; nodes that learn have learned from the world's people-free frames or its
  /// others.
  std::shared_ptr<Component> make() const;
  template <class T>
  std::shared_ptr<T> make_as() const {
    auto typed = std::dynamic_pointer_cast<T>(make());
    if (!typed) throw InternalError("the component is not of the kind that it declares");
    return typed;
  }
  std::shared_ptr<Component> make_untaught() const;
  void teach(Node& node) const;

  /// Types of all inputs: the declared ones, then those of input lists.
  std::vector<std::string> inputs() const;
  /// A call for a frame of the world; `frame` counts in the world.
  std::unique_ptr<Call> call(std::int64_t frame, bool optional_inputs = true) const;
  std::unique_ptr<Call> call(std::int64_t frame, const Provider& provider) const;
  Provider world_provider() const;

 private:
  /// Modalities that the trial's input lists name, by "from"; what the finder doesn't know is not
  /// in it.
  using Producers = std::map<std::string, std::shared_ptr<Modality>>;
  void make_producers();
  std::unique_ptr<Call> make_call(std::int64_t frame, const Provider& provider,
                                  bool optional_inputs) const;

  const Subject* subject_;
  const Trial* trial_;
  std::shared_ptr<const Scene> scene_;
  std::filesystem::path output_folder_;
  Producers producers_;
  std::vector<std::string> list_inputs_;  ///< "from" of every entry of input lists, in slot order
};

void check_source(const Stage& stage, Findings& findings);
void check_modality(const Stage& stage, Findings& findings);
void check_shape(const Stage& stage, Findings& findings);
void check_appearance(const Stage& stage, Findings& findings);
void check_motion(const Stage& stage, Findings& findings);
void check_detector(const Stage& stage, Findings& findings);
void check_describer(const Stage& stage, Findings& findings);
void check_affinity(const Stage& stage, Findings& findings);
void check_associator(const Stage& stage, Findings& findings);
void check_evaluator(const Stage& stage, Findings& findings);
void check_sink(const Stage& stage, Findings& findings);
void check_renderer(const Stage& stage, Findings& findings);
void check_learner(const Stage& stage, Findings& findings);

}  // namespace plaza::contract
