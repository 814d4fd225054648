#include "stage.h"

#include <algorithm>
#include <utility>

#include "digest.h"
#include "plaza/component/learner.h"

namespace plaza::contract {
namespace {

/// The nested component { "use": NAME, parameters }.
NamedPart make_part(const nlohmann::json& value, const Trial& trial, BuildContext context);

using Producers = std::map<std::string, std::shared_ptr<Modality>>;

void add_parts(const ComponentDeclaration& declaration, const nlohmann::json& values,
               const Trial& trial, const Producers& producers, BuildContext& context) {
  std::size_t slot = declaration.inputs.size();
  for (const ParameterSpec& p : declaration.parameters) {
    const nlohmann::json& value = values.contains(p.name) ? values.at(p.name) : p.default_value;
    if (value.is_null()) continue;
    BuildContext inner;
    inner.scene = context.scene;
    inner.seed = context.seed;
    inner.output_folder = context.output_folder;
    if (p.type == ParameterType::kPart) {
      context.part_lists[p.name] = {make_part(value, trial, inner)};
    } else if (p.type == ParameterType::kPartList) {
      for (const nlohmann::json& part : value) {
        context.part_lists[p.name].push_back(make_part(part, trial, inner));
      }
    } else if (p.type == ParameterType::kInputList) {
      for (const nlohmann::json& entry : value) {
        const std::string from = entry.value("from", "above");
        const auto producer = producers.find(from);
        context.input_lists[p.name].push_back(
            {slot++, from, producer == producers.end() ? nullptr : producer->second, entry});
      }
    }
  }
}

/// Parts and inputs reach a component through the context.
nlohmann::json plain_values(const ComponentDeclaration& declaration, nlohmann::json values) {
  for (const ParameterSpec& p : declaration.parameters) {
    const bool in_context = p.type == ParameterType::kPart || p.type == ParameterType::kPartList ||
                            p.type == ParameterType::kInputList;
    if (in_context) values.erase(p.name);
  }
  return values;
}

NamedPart make_part(const nlohmann::json& value, const Trial& trial, BuildContext context) {
  const std::string use = value.at("use").get<std::string>();
  const std::optional<Subject> subject = trial.finder ? trial.finder(use) : std::nullopt;
  if (!subject)
    throw InternalError("Trial::finder knows no \"" + use + "\", which is needed as a part");
  nlohmann::json values = value;
  values.erase("use");
  values.erase("name");
  context.name = value.value("name", use);
  context.in_order = subject->declaration.memory;
  add_parts(subject->declaration, values, trial, {}, context);
  return {context.name, subject->make(plain_values(subject->declaration, values), context)};
}

}  // namespace

Call::Call(const ComponentDeclaration& declaration, const std::vector<std::string>& inputs,
           std::int64_t frame, std::int64_t time_ns, const Provider& provider,
           const ListProvider& list_provider, bool optional_inputs)
    : io_(frame, time_ns, nullptr, {}, {}) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool needed = i >= declaration.inputs.size() || declaration.inputs[i].required;
    PayloadPtr payload;
    if (i >= declaration.inputs.size()) {
      payload = list_provider(i - declaration.inputs.size(), frame);
    }
    if (!payload && (needed || optional_inputs)) payload = provider(inputs[i], frame);
    // what is connected but was not emitted is an empty slot, what is not connected is -1
    inputs_.push_back(needed || optional_inputs ? static_cast<int>(slots_.size()) : -1);
    slots_.push_back(std::move(payload));
  }
  for (std::size_t i = 0; i < declaration.outputs.size(); ++i) {
    outputs_.push_back(static_cast<int>(slots_.size()));
    slots_.push_back(nullptr);
  }
  io_ = NodeIo(frame, time_ns, slots_.data(), inputs_, outputs_);
}

std::string Call::digest_of_outputs() const {
  std::string text;
  for (std::size_t i = 0; i < outputs_.size(); ++i) text += digest(output(i)) + "\n";
  return text;
}

Stage::Stage(const Subject& subject, const Trial& trial, std::filesystem::path output_folder)
    : subject_(&subject),
      trial_(&trial),
      scene_(trial.scene ? trial.scene : trial.world->scene()),
      output_folder_(std::move(output_folder)) {
  make_producers();
}

void Stage::make_producers() {
  for (const ParameterSpec& p : declaration().parameters) {
    if (p.type != ParameterType::kInputList || !trial().values.contains(p.name)) continue;
    for (const nlohmann::json& entry : trial().values.at(p.name)) {
      const std::string& from = list_inputs_.emplace_back(entry.value("from", "above"));
      const auto subject = trial().finder ? trial().finder(from) : std::nullopt;
      if (!subject || producers_.contains(from)) continue;
      BuildContext context;
      context.name = from;
      context.scene = scene_;
      context.seed = 7;
      add_parts(subject->declaration, nlohmann::json::object(), trial(), {}, context);
      auto modality =
          std::dynamic_pointer_cast<Modality>(subject->make(nlohmann::json::object(), context));
      if (!modality) continue;
      teach(*modality);
      producers_[from] = std::move(modality);
    }
  }
}

std::shared_ptr<Component> Stage::make_untaught() const {
  BuildContext context;
  context.name = declaration().name;
  context.scene = scene_;
  context.seed = 7;
  context.output_folder = output_folder_;
  context.in_order = declaration().memory;
  add_parts(declaration(), trial().values, trial(), producers_, context);
  auto component = subject_->make(plain_values(declaration(), trial().values), context);
  if (!component) throw InternalError("nothing was made");
  return component;
}

std::shared_ptr<Component> Stage::make() const {
  auto component = make_untaught();
  if (auto* node = dynamic_cast<Node*>(component.get())) teach(*node);
  return component;
}

void Stage::teach(Node& node) const {
  Learner* learner = node.learner();
  if (learner == nullptr) return;
  std::int64_t seen = 0;
  if (const std::optional<LearningPlan> plan = learner->plan()) {
    const std::int64_t end =
        std::min(plan->first.value_or(world().frame_count()), world().frame_count());
    for (std::int64_t frame = 0; frame < end; frame += plan->every) {
      learner->learn(plan->people_free_only ? world().people_free(frame) : world().frames(frame));
      ++seen;
    }
  }
  learner->finish(seen);
}

std::vector<std::string> Stage::inputs() const {
  std::vector<std::string> types;
  for (const PortSpec& port : declaration().inputs) types.push_back(port.type);
  for (const ParameterSpec& p : declaration().parameters) {
    if (p.type != ParameterType::kInputList || !trial().values.contains(p.name)) continue;
    types.insert(types.end(), trial().values.at(p.name).size(), p.port);
  }
  return types;
}

Provider Stage::world_provider() const {
  return [this](const std::string& port, std::int64_t frame) -> PayloadPtr {
    return frame < world().frame_count() ? world().payload(port, frame) : nullptr;
  };
}

std::unique_ptr<Call> Stage::make_call(std::int64_t frame, const Provider& provider,
                                       bool optional_inputs) const {
  // evidence of the very modality that the component matches with, from the images of this frame
  // alone
  const ListProvider evidence_of = [&](std::size_t entry, std::int64_t at) -> PayloadPtr {
    const auto producer = producers_.find(list_inputs_.at(entry));
    if (producer == producers_.end()) return nullptr;
    const PayloadPtr images = provider(std::string(FrameSet::kPort), at);
    if (!images) return nullptr;
    const auto& frames = static_cast<const FrameSet&>(*images);
    auto evidence = std::make_shared<EvidenceSet>();
    for (std::size_t camera = 0; camera < frames.views.size(); ++camera) {
      const cv::Mat& image = frames.views[camera];
      evidence->views.push_back(
          image.empty() ? nullptr : producer->second->prepare(image, camera, cv::Mat()).evidence);
    }
    return evidence;
  };
  return std::make_unique<Call>(declaration(), inputs(), frame, scene_->time_of_frame(frame),
                                provider, evidence_of, optional_inputs);
}

std::unique_ptr<Call> Stage::call(std::int64_t frame, bool optional_inputs) const {
  return make_call(frame, world_provider(), optional_inputs);
}

std::unique_ptr<Call> Stage::call(std::int64_t frame, const Provider& provider) const {
  return make_call(frame, provider, true);
}

}  // namespace plaza::contract
