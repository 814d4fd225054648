#include "tests/bench/taught_clip.h"

#include <filesystem>
#include <set>

#include "framework/execution/frame_reader.h"
#include "framework/execution/learn.h"
#include "framework/plugin/loader.h"
#include "modalities/color/color.h"
#include "modalities/edges/edges.h"
#include "tests/support/into_registry.h"

namespace plaza::bench {
namespace {

namespace fs = std::filesystem;

/// All plugins of the build tree; what is looked into from outside is linked in instead.
const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry r;
    test::IntoRegistry into(r);
    into.add<HierarchicalGrid>();
    into.add<edges::Edges>();
    into.add<ColorModality>();
    const std::set<std::string> linked = {"plaza_hierarchical_grid.so", "plaza_edges.so",
                                          "plaza_color.so"};
    for (const fs::path& library :
         find_plugins({fs::path(PLAZA_BINARY_DIR) / "lib" / "plaza" / "plugins"})) {
      if (!linked.contains(library.filename().string())) load_plugin(library, r);
    }
    return r;
  }();
  return kRegistry;
}

}  // namespace

TaughtClip::TaughtClip(const std::string& pipeline, const std::vector<std::string>& sets,
                       const Chosen& chosen)
    : resolved_(read_pipeline_in_scene(
          {.file = fs::path(PLAZA_SOURCE_DIR) / "pipelines" / pipeline, .sets = sets}, registry())),
      assembly_(assemble(resolved_.pipeline, resolved_.scene, fs::temp_directory_path())),
      plan_(make_plan(resolved_.pipeline, assembly_)) {
  for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
    const std::string& name = plan_.nodes[i].name;
    if (name == "color" || name == "edges" || name == "detector") nodes_.push_back(i);
  }
  if (!nodes_.empty()) {
    detector_ = dynamic_cast<const HierarchicalGrid*>(plan_.nodes[nodes_.back()].node.get());
  }
  if (detector_ == nullptr) throw InternalError(pipeline + " has no ground grid any more");
  FrameReader reader(plan_, *resolved_.scene);
  reader.open();
  Progress quiet(ProgressStyle::kQuiet);
  learn_models(learning_tasks(plan_, resolved_.pipeline, *resolved_.scene), plan_, reader, kThreads,
               quiet);
  const std::int64_t count = reader.frame_count().value_or(0);
  for (std::int64_t frame = 0; frame < count; ++frame) {
    if (frame % chosen.every >= chosen.run) continue;
    if (reader.next() != frame) reader.seek(frame);
    FrameState state;
    if (!reader.read_clock(state)) break;
    frames_.push_back({frame, state.slots[static_cast<std::size_t>(plan_.frames_slot)]});
  }
  if (frames_.empty()) throw UserError(pipeline + " has no frames");
}

void TaughtClip::run(const std::function<void(const FrameState&)>& done) const {
  std::size_t next = 0;
  FrameLoop loop;
  loop.read = [&](FrameState& state) {
    if (next == frames_.size()) return false;
    const Frame& frame = frames_[next++];
    state.reset(frame.index, resolved_.scene->time_of_frame(frame.index), plan_.slot_count,
                plan_.nodes.size());
    state.slots[static_cast<std::size_t>(plan_.frames_slot)] = frame.images;
    return true;
  };
  for (const std::size_t index : nodes_) {
    const PlannedNode& node = plan_.nodes[index];
    loop.stages.push_back({.ordered = node.memory, .work = [&node](FrameState& state) {
                             NodeIo io(state.frame, state.time_ns, state.slots.data(), node.inputs,
                                       node.outputs);
                             node.node->process(io);
                           }});
  }
  loop.done = [&](FrameState& state) {
    done(state);
    state.slots.clear();
  };
  const LoopEnd end = run_frames(loop, kThreads);
  if (end.fault) std::rethrow_exception(end.fault);
}

const Modality& TaughtClip::modality(const std::string& name) const {
  for (const PlannedNode& node : plan_.nodes) {
    if (node.name == name) return dynamic_cast<const Modality&>(*node.node);
  }
  throw InternalError("there is no node '" + name + "'");
}

SearchResult TaughtClip::search(const FrameState& state) const {
  const PlannedNode& node = plan_.nodes[nodes_.back()];
  std::vector<PayloadPtr> slots = state.slots;
  return detector_->search(
      NodeIo(state.frame, state.time_ns, slots.data(), node.inputs, node.outputs));
}

}  // namespace plaza::bench
