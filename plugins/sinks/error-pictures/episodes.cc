#include "plugins/sinks/error-pictures/episodes.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace plaza::error_pictures {
namespace {

void keep_longest(std::vector<Episode>& episodes, std::size_t most) {
  std::stable_sort(episodes.begin(), episodes.end(), [](const Episode& a, const Episode& b) {
    if (a.count != b.count) return a.count > b.count;
    return a.first_frame < b.first_frame;
  });
  if (episodes.size() > most) episodes.resize(most);
}

}  // namespace

void EpisodeBook::close_before(std::int64_t frame) {
  bool closed = false;
  for (std::size_t i = 0; i < open_.size();) {
    if (open_[i].last_frame + gap_frames_ >= frame) {
      ++i;
      continue;
    }
    closed_.push_back(std::move(open_[i]));
    open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(i));
    closed = true;
  }
  if (closed) keep_longest(closed_, most_);
}

void EpisodeBook::add(const FiledError& error, const std::function<Pictured()>& draw) {
  close_before(error.frame);
  ++errors_;
  const auto same = [&](const Episode& e) {
    if (e.last_frame == error.frame || e.id != error.id) return false;
    return error.id || (e.position_m - error.position_m).norm() <= reach_m_;
  };
  auto episode = std::find_if(open_.begin(), open_.end(), same);
  if (episode == open_.end()) {
    ++episodes_;
    episode = open_.emplace(open_.end());
    episode->first_frame = error.frame;
    episode->id = error.id;
  }
  episode->last_frame = error.frame;
  episode->position_m = error.position_m;
  ++episode->count;
  if (!std::has_single_bit(static_cast<std::uint64_t>(episode->count))) return;
  Pictured pictured = draw();
  episode->picture = std::move(pictured.picture);
  episode->who = std::move(pictured.who);
  episode->caption = std::move(pictured.caption);
  episode->pictured_frame = error.frame;
}

std::vector<Episode> EpisodeBook::longest() const {
  std::vector<Episode> all = closed_;
  all.insert(all.end(), open_.begin(), open_.end());
  keep_longest(all, most_);
  return all;
}

}  // namespace plaza::error_pictures
