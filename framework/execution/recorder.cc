#include "framework/execution/recorder.h"

#include <algorithm>
#include <system_error>

#include "plaza/core/error.h"
#include "plaza/data/observation.h"
#include "plaza/data/track.h"

namespace plaza {
namespace {

// how much of a killed run may be missing from the parts that it leaves
constexpr std::chrono::seconds kFlushInterval{2};
// tracks are written anew each time: rarer when that takes long, to cost at most this share
constexpr int kFlushShare = 50;

int slot_of(const ExecutionPlan& plan, const std::optional<Wire>& wire) {
  if (!wire) return -1;
  return plan.nodes[static_cast<std::size_t>(wire->node)]
      .outputs[static_cast<std::size_t>(wire->output)];
}

}  // namespace

Recorder::Recorder(const std::vector<Branch>& branches, const ExecutionPlan& plan,
                   const Scene& scene, const std::filesystem::path& folder,
                   std::int64_t first_frame)
    : scene_(scene), next_flush_(std::chrono::steady_clock::now() + kFlushInterval) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const Branch& branch = branches[b];
    BranchFiles files;
    files.folder = b == 0 ? folder : folder / branch.name;
    std::error_code error;
    std::filesystem::create_directories(files.folder, error);
    if (error) {
      throw UserError("cannot create the folder " + files.folder.string() + ": " + error.message() +
                      "; choose another one with --out");
    }
    remove_earlier_results(files.folder, scene);
    files.tracks_slot = slot_of(plan, branch.tracks);
    files.observations_slot = slot_of(plan, branch.observations);
    if (files.tracks_slot >= 0)
      files.tracks = std::make_unique<TrackStore>(branch.name, first_frame);
    if (files.observations_slot >= 0) {
      files.observations = std::make_unique<ObservationsFile>(files.folder);
    }
    branches_.push_back(std::move(files));
  }
}

void Recorder::add_tracks(BranchFiles& branch, const FrameState& state) {
  if (branch.tracks_slot < 0) return;
  const PayloadPtr& payload = state.slots[static_cast<std::size_t>(branch.tracks_slot)];
  if (payload) branch.tracks->add(dynamic_cast<const Tracks&>(*payload));
  branch.tracks_end = state.frame + 1;
}

void Recorder::add_frame(const FrameState& state) {
  // before this frame is added: one that can't be flushed has not been done
  if (const auto now = std::chrono::steady_clock::now(); now >= next_flush_) {
    flush(state.frame);
    const auto end = std::chrono::steady_clock::now();
    next_flush_ = end + std::max<std::chrono::steady_clock::duration>(kFlushInterval,
                                                                      kFlushShare * (end - now));
  }
  for (BranchFiles& branch : branches_) {
    add_tracks(branch, state);
    if (branch.observations_slot < 0) continue;
    const PayloadPtr& payload = state.slots[static_cast<std::size_t>(branch.observations_slot)];
    if (payload) branch.observations->add(state.frame, dynamic_cast<const Observations&>(*payload));
  }
}

void Recorder::flush(std::int64_t end_frame) {
  for (BranchFiles& branch : branches_) {
    if (branch.observations) branch.observations->flush();
    if (branch.tracks) write_tracks_so_far(branch.folder, *branch.tracks, end_frame, scene_);
  }
}

void Recorder::add_rest(const FrameState& state) {
  for (BranchFiles& branch : branches_) {
    if (state.frame >= branch.tracks_end) add_tracks(branch, state);
  }
}

void Recorder::add_flushed(const FrameState& state) {
  for (BranchFiles& branch : branches_) add_tracks(branch, state);
}

std::vector<Artifact> Recorder::write(std::int64_t end_frame) {
  std::vector<Artifact> artifacts;
  std::exception_ptr first_fault;  // one file that can't be written must not keep the others away
  for (BranchFiles& branch : branches_) {
    try {
      if (branch.observations) {
        branch.observations->commit();
        artifacts.push_back({branch.observations->file(), "observations on the ground"});
      }
    } catch (const Error&) {
      if (!first_fault) first_fault = std::current_exception();
    }
    try {
      if (branch.tracks) {
        const auto files = write_tracks(branch.folder, *branch.tracks, end_frame, scene_);
        artifacts.insert(artifacts.end(), files.begin(), files.end());
      }
    } catch (const Error&) {
      if (!first_fault) first_fault = std::current_exception();
    }
  }
  if (first_fault) std::rethrow_exception(first_fault);
  return artifacts;
}

const TrackStore* Recorder::tracks_in(int slot) const {
  for (const BranchFiles& branch : branches_) {
    if (slot >= 0 && branch.tracks_slot == slot) return branch.tracks.get();
  }
  return nullptr;
}

}  // namespace plaza
