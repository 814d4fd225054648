#include "plugins/detectors/hierarchical-grid/joint_search.h"

#include <algorithm>
#include <memory>

#include "plugins/detectors/hierarchical-grid/scenario.h"

namespace plaza {

JointSearch::JointSearch(const StateGrid& grid, const GridSearch& search,
                         std::span<const Neighbour> neighbours, std::span<const Neighbour> rivals,
                         const Options& options)
    : grid_(&grid),
      search_(&search),
      neighbours_(neighbours),
      rivals_(rivals),
      ring_(cells_around(grid.finest(), 0)),
      options_(options) {
  for (const TemplateLayer& size : search.sizes()) {
    const double z = (size.scale - 1) / options.size_sigma;
    priors_.push_back(-0.5 * z * z);
  }
}

Eigen::Vector2d JointSearch::position(CellIndex cell) const {
  return grid_->position(grid_->levels() - 1, cell);
}

bool JointSearch::near(CellIndex a, CellIndex b) const {
  const int width = grid_->finest().columns;
  const int columns = static_cast<int>(b) % width - static_cast<int>(a) % width;
  const int rows = static_cast<int>(b) / width - static_cast<int>(a) / width;
  return std::any_of(rivals_.begin(), rivals_.end(),
                     [&](const Neighbour& n) { return n.columns == columns && n.rows == rows; });
}

std::unique_ptr<JointSearch::Scenario> JointSearch::without_somebody(const Scenario& before) const {
  for (const CellIndex doubted : before.weakest()) {
    Scenario rest(before);
    rest.leave_out(doubted);
    std::unique_ptr<Scenario> best;
    for (const CellIndex start : rest.starts()) {
      auto without = std::make_unique<Scenario>(rest);
      without->accept_at(start);
      without->accept();
      // otherwise at most one came for one, and places near by were climbed already
      if (without->size() <= before.size() || !without->settle()) continue;
      if (without->worth() > (best ? *best : before).worth()) best = std::move(without);
    }
    if (best) return best;
  }
  return nullptr;
}

std::vector<FoundPerson> JointSearch::infer(const AllEvidence& evidence,
                                            const SearchResult& first) const {
  auto scenario = std::make_unique<Scenario>(*this, evidence, first);
  scenario->settle();
  for (int round = 0; round < std::max(options_.rounds, 1); ++round) {
    std::unique_ptr<Scenario> better = without_somebody(*scenario);
    if (!better) break;
    scenario = std::move(better);
  }
  return std::move(*scenario).people();
}

}  // namespace plaza
