#include "framework/execution/missing_views.h"

#include <algorithm>

namespace plaza {
namespace {

constexpr std::size_t kMostGapsShown = 8;

}  // namespace

MissingViews::MissingViews(const Scene& scene) {
  for (const Camera& camera : scene.cameras) {
    views_.push_back({.camera = camera.name(), .gaps = {}, .missing = 0});
  }
}

void MissingViews::add(const FrameSet& frames) {
  ++frames_;
  last_frame_ = frames.frame;
  for (std::size_t c = 0; c < std::min(views_.size(), frames.views.size()); ++c) {
    if (!frames.views[c].empty()) continue;
    View& view = views_[c];
    ++view.missing;
    if (!view.gaps.empty() && view.gaps.back().second == frames.frame - 1) {
      view.gaps.back().second = frames.frame;
    } else {
      view.gaps.emplace_back(frames.frame, frames.frame);
    }
  }
}

std::vector<std::string> MissingViews::notes() const {
  std::vector<std::string> notes;
  const auto all_missing = [this](const View& view) { return view.missing == frames_; };
  if (std::ranges::all_of(views_, all_missing)) return notes;
  for (const View& view : views_) {
    if (view.missing == 0) continue;
    std::string note = "camera '" + view.camera + "': no image in ";
    if (all_missing(view)) {
      notes.push_back(note + "any frame");
      continue;
    }
    note += view.missing == 1 ? "frame " : "frames ";
    for (std::size_t g = 0; g < std::min(view.gaps.size(), kMostGapsShown); ++g) {
      const auto [first, last] = view.gaps[g];
      if (g > 0) note += ", ";
      note += std::to_string(first + 1);
      if (last == first) continue;
      note += '-';
      note += std::to_string(last + 1);
    }
    if (view.gaps.size() > kMostGapsShown) note += ", ...";
    note += " (" + std::to_string(view.missing) + " of " + std::to_string(frames_) + ")";
    const auto [first, last] = view.gaps.back();
    if (last == last_frame_ && last > first) {
      note += "; its last one is that of frame " + std::to_string(first);
    }
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace plaza
