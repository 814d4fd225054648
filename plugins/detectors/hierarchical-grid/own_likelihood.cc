#include "plugins/detectors/hierarchical-grid/own_likelihood.h"

#include <algorithm>

namespace plaza {
namespace {

/// Nothing known of any cell.
LevelLikelihood unknown_like(const LevelLikelihood& other) {
  LevelLikelihood out;
  out.joint.assign(other.joint.size(), kUnknown);
  out.per_view = out.joint;
  out.trust.assign(other.joint.size(), 0);
  out.evaluated.assign(other.evaluated.size(), 0);
  out.views.assign(other.views.size(), out.joint);
  out.view_trust.assign(other.views.size(), std::vector<float>(other.joint.size(), 0));
  return out;
}

}  // namespace

OwnLikelihood::OwnLikelihood(const GroundGrid& grid, const GridSearch& search,
                             std::span<const Neighbour> neighbours, std::span<const double> priors,
                             const AllEvidence& whole, const SearchResult& first)
    : grid_(&grid),
      search_(&search),
      neighbours_(neighbours),
      priors_(priors),
      whole_(&whole),
      first_(&first),
      ring_(cells_around(grid, 0)),
      known_values_(priors.size(), unknown_like(first.levels.back())),
      known_(priors.size(), std::vector<char>(first.levels.back().joint.size(), 0)),
      surface_(first.levels.back().joint.size(), kUnknown) {}

void OwnLikelihood::use(Remainder rest) {
  own_ = std::move(rest);
  for (const PlacedBody& body : looked_at_) {
    known_[body.size][body.cell] = 0;
    known_values_[body.size].joint[body.cell] = kUnknown;
    for (std::vector<double>& view : known_values_[body.size].views) view[body.cell] = kUnknown;
  }
  looked_at_.clear();
}

void OwnLikelihood::look_at(std::span<const CellIndex> cells, std::size_t size) {
  std::vector<CellIndex> missing;
  for (const CellIndex cell : cells) {
    for (const CellIndex other : cells_of(*grid_, cell, neighbours_)) {
      if (known_[size][other] == 0) missing.push_back(other);
      known_[size][other] = 1;
    }
  }
  if (missing.empty()) return;
  LevelLikelihood& values = known_values_[size];
  const LevelLikelihood& before = first_->levels.back();
  ViewCells unseen(values.views.size());
  for (std::size_t camera = 0; camera < unseen.size(); ++camera) {
    const bool whole =
        std::equal(own_.evidence.begin(), own_.evidence.end(), whole_->begin(),
                   [&](const auto& a, const auto& b) { return a[camera] == b[camera]; });
    for (const CellIndex cell : missing) {
      // where nobody else is in a view, the first search has seen all that there is
      if (whole && size == 0 && before.evaluated[cell] != 0) {
        values.views[camera][cell] = before.views[camera][cell];
        values.view_trust[camera][cell] = before.view_trust[camera][cell];
      } else {
        unseen[camera].push_back(cell);
      }
    }
  }
  search_->judge(own_, first_->baselines, size, unseen, values);
  search_->join(missing, values);
  for (const CellIndex cell : missing) looked_at_.push_back({cell, size});
}

double OwnLikelihood::value(const PlacedBody& body) {
  const CellIndex cell[] = {body.cell};
  look_at(cell, body.size);
  return smoothed_at(*grid_, known_values_[body.size].joint, neighbours_, body.cell) +
         priors_[body.size];
}

double OwnLikelihood::score(const PlacedBody& body) {
  const double smoothed = value(body);
  return search_->score_of(body.cell, smoothed, known_values_[body.size]);
}

Peak OwnLikelihood::peak(const PlacedBody& body, double max_sigma_m) {
  const std::vector<CellIndex> ring = cells_of(*grid_, body.cell, ring_);
  look_at(ring, body.size);
  for (const CellIndex cell : ring) surface_[cell] = value({cell, body.size});
  const Peak peak = peak_at(*grid_, surface_, body.cell, max_sigma_m);
  for (const CellIndex cell : ring) surface_[cell] = kUnknown;
  return peak;
}

std::vector<double> OwnLikelihood::views(const PlacedBody& body) {
  const CellIndex cell[] = {body.cell};
  look_at(cell, body.size);
  std::vector<double> views;
  for (const std::vector<double>& view : known_values_[body.size].views) {
    views.push_back(view[body.cell]);
  }
  return views;
}

}  // namespace plaza
