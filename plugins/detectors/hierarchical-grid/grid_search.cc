#include "plugins/detectors/hierarchical-grid/grid_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plaza/core/parallel.h"
#include "plugins/detectors/hierarchical-grid/silhouette_codec.h"

namespace plaza {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
constexpr double kReach = 0.125;  ///< of a box's height: how far a person's evidence may reach
constexpr std::size_t kTemplatesPerTask = 256;  ///< templates that one task matches

/// Median of the numbers that are known; NaN without any.
double median_of_known(std::span<const double> values) {
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](double v) { return std::isfinite(v); });
  if (known.empty()) return kUnknown;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return *middle;
}

/// Logarithm of the mean of exp(values), over what is known; NaN without any.
double log_mean(std::span<const double> values) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double v : values) {
    if (std::isfinite(v)) largest = std::max(largest, v);
  }
  if (!std::isfinite(largest)) return kUnknown;
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    sum += std::exp(v - largest);
    ++count;
  }
  return largest + std::log(sum / static_cast<double>(count));
}

}  // namespace

double GridSearch::score_of(CellIndex cell, double smoothed, const LevelLikelihood& level) const {
  return smoothed / (level.trust[cell] + trust_.empty_views);
}

GridSearch::GridSearch(const StateGrid& grid, const TemplateHierarchy& hierarchy,
                       const ShapeModel& model, std::vector<Witness> witnesses,
                       std::span<const Camera> cameras, const ViewTrust& trust, double refine_above,
                       int spread)
    : grid_(&grid),
      hierarchy_(&hierarchy),
      witnesses_(std::move(witnesses)),
      cameras_(cameras.size()),
      trust_(trust),
      refine_above_(refine_above),
      spread_(spread) {
  for (const Camera& camera : cameras) centres_m_.push_back(camera.centre().head<2>());
  boxes_.assign(cameras_, std::vector<Box>(grid.size(grid.levels() - 1)));
  for (std::size_t layer = 0; layer < hierarchy.layers().size(); ++layer) {
    const auto [level, scale] = hierarchy.layers()[layer];
    auto& batches = batches_.emplace_back(witnesses_.size() * cameras_);
    auto& templates = template_of_cell_.emplace_back(cameras_);
    auto& trusts = cell_trust_.emplace_back(cameras_);
    parallel_for(cameras_, [&, level = level, scale = scale](std::size_t camera) {
      const LevelTemplates& stored = hierarchy.templates(camera, layer);
      templates[camera].assign(grid.size(level), kUnseen);
      trusts[camera].assign(grid.size(level), 0);
      const Eigen::Vector2i image_size(cameras[camera].width(), cameras[camera].height());
      std::vector<Pose> poses;
      for (std::size_t i = 0; i < stored.cells.size(); ++i) {
        const CellIndex cell = stored.cells[i];
        std::size_t offset = stored.offsets[i];
        trusts[camera][cell] =
            static_cast<float>(trust.of(decode(stored.bytes, offset), image_size));
        templates[camera][cell] = static_cast<std::uint32_t>(poses.size());
        poses.push_back({grid.position(level, cell), 0, scale});
      }
      const StoredShape shape(model, grid, {level, scale}, stored);
      for (std::size_t w = 0; w < witnesses_.size(); ++w) {
        batches[w * cameras_ + camera] = witnesses_[w].modality->sample(shape, poses, camera);
      }
    });
  }
  for (std::size_t level = 0; level < grid.levels(); ++level) {
    std::vector<char> seen(grid.size(level), 0);
    for (std::size_t camera = 0; camera < cameras_; ++camera) {
      for (const CellIndex cell : hierarchy.templates(camera, level).cells) seen[cell] = 1;
    }
    auto& cells = seen_cells_.emplace_back();
    for (std::size_t cell = 0; cell < seen.size(); ++cell) {
      if (seen[cell] != 0) cells.push_back(static_cast<CellIndex>(cell));
    }
  }
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    const LevelTemplates& stored = hierarchy.templates(camera, grid.levels() - 1);
    for (std::size_t i = 0; i < stored.cells.size(); ++i) {
      std::size_t offset = stored.offsets[i];
      boxes_[camera][stored.cells[i]] = decode(stored.bytes, offset).box;
    }
  }
}

std::vector<CellIndex> GridSearch::wanted_cells(std::size_t level,
                                                const LevelLikelihood* parents) const {
  if (parents == nullptr || refine_above_ == 0) return seen_cells_[level];
  // where all cells are alike, rounding must not lift them above their own mean
  const double limit = log_mean(parents->per_view) + std::log(refine_above_) + 1e-9;
  const GroundGrid& above = grid_->grid(level - 1);
  std::vector<char> split(parents->per_view.size(), 0);
  for (int row = 0; row < above.rows; ++row) {
    for (int column = 0; column < above.columns; ++column) {
      const double value =
          parents->per_view[static_cast<std::size_t>(row * above.columns + column)];
      if (std::isfinite(value) && !(value > limit)) continue;
      const int reach = std::isfinite(value) ? spread_ : 0;
      for (int r = std::max(row - reach, 0); r <= std::min(row + reach, above.rows - 1); ++r) {
        for (int c = std::max(column - reach, 0); c <= std::min(column + reach, above.columns - 1);
             ++c) {
          split[static_cast<std::size_t>(r * above.columns + c)] = 1;
        }
      }
    }
  }
  std::vector<CellIndex> wanted;
  for (const CellIndex cell : seen_cells_[level]) {
    if (split[grid_->parent(level, cell)] != 0) wanted.push_back(cell);
  }
  return wanted;
}

std::vector<GridSearch::Values> GridSearch::evaluate(std::size_t layer, const ViewCells& wanted,
                                                     const AllEvidence& evidence) const {
  struct Task {
    std::size_t pair = 0;
    std::size_t begin = 0, end = 0;  ///< of the camera's lists below
  };
  std::vector<std::vector<std::uint32_t>> which(cameras_);
  std::vector<std::vector<std::size_t>> places(cameras_);  // of their cells in `wanted`
  std::vector<Task> tasks;
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    for (std::size_t i = 0; i < wanted[camera].size(); ++i) {
      const std::uint32_t index = template_of_cell_[layer][camera][wanted[camera][i]];
      if (index == kUnseen) continue;
      which[camera].push_back(index);
      places[camera].push_back(i);
    }
    for (std::size_t w = 0; w < witnesses_.size(); ++w) {
      if (!evidence[w][camera]) continue;
      for (std::size_t begin = 0; begin < which[camera].size(); begin += kTemplatesPerTask) {
        tasks.push_back({w * cameras_ + camera, begin,
                         std::min(begin + kTemplatesPerTask, which[camera].size())});
      }
    }
  }
  std::vector<Values> values;
  for (std::size_t pair = 0; pair < witnesses_.size() * cameras_; ++pair) {
    values.emplace_back(wanted[pair % cameras_].size(), kUnknown);
  }
  parallel_for(tasks.size(), [&](std::size_t t) {
    const Task& task = tasks[t];
    const std::size_t w = task.pair / cameras_, camera = task.pair % cameras_;
    std::vector<double> found(task.end - task.begin);
    witnesses_[w].modality->match(
        *evidence[w][camera], *batches_[layer][task.pair],
        std::span(which[camera]).subspan(task.begin, task.end - task.begin), found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      values[task.pair][places[camera][task.begin + i]] = found[i];
    }
  });
  return values;
}

SearchResult GridSearch::search(const AllEvidence& evidence) const {
  SearchResult result;
  result.exhaustive = seen_cells_.back().size();
  const std::size_t pairs = witnesses_.size() * cameras_;
  std::vector<double> baselines(pairs, kUnknown);
  for (std::size_t level = 0; level < grid_->levels(); ++level) {
    const LevelLikelihood* parents = level > 0 ? &result.levels.back() : nullptr;
    const ViewCells wanted(cameras_, wanted_cells(level, parents));
    const std::vector<Values> values = evaluate(level, wanted, evidence);
    result.evaluated += wanted.front().size();
    for (std::size_t pair = 0; pair < pairs; ++pair) {
      if (!std::isfinite(baselines[pair])) baselines[pair] = median_of_known(values[pair]);
    }

    LevelLikelihood here;
    here.joint.assign(grid_->size(level), kUnknown);
    here.per_view = here.joint;
    here.trust.assign(here.joint.size(), 0);
    here.evaluated.assign(grid_->size(level), 0);
    here.views.assign(cameras_, Values(grid_->size(level), kUnknown));
    here.view_trust.assign(cameras_, std::vector<float>(grid_->size(level), 0));
    if (parents != nullptr) {
      for (std::size_t cell = 0; cell < here.joint.size(); ++cell) {
        const CellIndex parent = grid_->parent(level, static_cast<CellIndex>(cell));
        here.joint[cell] = parents->joint[parent];
        here.per_view[cell] = parents->per_view[parent];
        here.trust[cell] = parents->trust[parent];
      }
    }
    combine(level, wanted, values, baselines, {}, here);
    result.levels.push_back(std::move(here));
  }
  result.baselines = std::move(baselines);
  return result;
}

void GridSearch::combine(std::size_t layer, const ViewCells& wanted, std::span<const Values> values,
                         std::span<const double> baselines,
                         std::span<const std::vector<Box>> hidden, LevelLikelihood& level) const {
  std::vector<CellIndex> cells;
  std::vector<char> listed(level.joint.size(), 0);
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    for (std::size_t i = 0; i < wanted[camera].size(); ++i) {
      double sum = 0;
      bool told = false;
      for (std::size_t w = 0; w < witnesses_.size(); ++w) {
        const std::size_t pair = w * cameras_ + camera;
        const double value = values[pair][i];
        if (!std::isfinite(value)) continue;
        sum += witnesses_[w].weight * (value - baselines[pair]);
        told = true;
      }
      const CellIndex cell = wanted[camera][i];
      level.views[camera][cell] = told ? sum : kUnknown;
      if (told) {
        float trust = cell_trust_[layer][camera][cell];
        if (trust_.hidden_loss > 0 && !hidden.empty()) {
          trust *= static_cast<float>(trust_.of_hidden(boxes_[camera][cell], hidden[camera]));
        }
        level.view_trust[camera][cell] = trust;
      }
      if (listed[cell] == 0) cells.push_back(cell);
      listed[cell] = 1;
    }
  }
  join(cells, level);
}

void GridSearch::join(std::span<const CellIndex> cells, LevelLikelihood& level) const {
  for (const CellIndex cell : cells) {
    double sum = 0, trust = 0;
    for (std::size_t camera = 0; camera < cameras_; ++camera) {
      const double view = level.views[camera][cell];
      if (!std::isfinite(view)) continue;
      const double share = level.view_trust[camera][cell];
      sum += share * view;
      trust += share;
    }
    level.trust[cell] = trust;
    level.joint[cell] = trust > 0 ? sum : kUnknown;
    level.per_view[cell] = trust > 0 ? sum / trust : kUnknown;
    level.evaluated[cell] = trust > 0 ? 1 : 0;
  }
}

void GridSearch::judge(const Remainder& rest, std::span<const double> baselines, std::size_t size,
                       const ViewCells& cells, LevelLikelihood& finest) const {
  const std::size_t layer = grid_->levels() - 1 + size;
  combine(layer, cells, evaluate(layer, cells, rest.evidence), baselines, rest.hidden, finest);
}

Remainder GridSearch::explain(Remainder rest, std::span<const PlacedBody> people) const {
  const std::vector<PlacedBody> everybody(people.begin(), people.end());
  return explain(std::move(rest), std::vector<std::vector<PlacedBody>>(cameras_, everybody));
}

Remainder GridSearch::explain_to(CellIndex cell, Remainder rest, std::span<const PlacedBody> people,
                                 bool nearer_only) const {
  std::vector<std::vector<PlacedBody>> of_camera(cameras_);
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    std::copy_if(
        people.begin(), people.end(), std::back_inserter(of_camera[camera]),
        [&](const PlacedBody& body) {
          return touch(camera, body.cell, cell) &&
                 (!nearer_only || distance_m(camera, body.cell) < distance_m(camera, cell));
        });
  }
  return explain(std::move(rest), of_camera);
}

Remainder GridSearch::explain(Remainder rest,
                              std::span<const std::vector<PlacedBody>> of_camera) const {
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    for (const PlacedBody& body : of_camera[camera]) {
      const Box& box = boxes_[camera][body.cell];
      if (box.width > 0) rest.hidden[camera].push_back(box);
    }
  }
  parallel_for(witnesses_.size() * cameras_, [&](std::size_t pair) {
    const std::size_t w = pair / cameras_, camera = pair % cameras_;
    EvidencePtr& view = rest.evidence[w][camera];
    if (!view) return;
    for (std::size_t size = 0; size < sizes().size(); ++size) {
      const std::size_t layer = grid_->levels() - 1 + size;
      std::vector<std::uint32_t> which;
      for (const PlacedBody& body : of_camera[camera]) {
        if (body.size != size) continue;
        const std::uint32_t index = template_of_cell_[layer][camera][body.cell];
        if (index != kUnseen) which.push_back(index);
      }
      // who isn't in a view leaves its evidence as it is
      if (which.empty()) continue;
      view = witnesses_[w].modality->explain(view, *batches_[layer][pair], which);
    }
  });
  return rest;
}

double GridSearch::distance_m(std::size_t camera, CellIndex cell) const {
  return (grid_->position(grid_->levels() - 1, cell) - centres_m_[camera]).norm();
}

bool GridSearch::touch(std::size_t camera, CellIndex a, CellIndex b) const {
  const Box &p = boxes_[camera][a], &q = boxes_[camera][b];
  const double reach = kReach * (p.height + q.height);
  return p.width > 0 && q.width > 0 && p.left < q.right() + reach && q.left < p.right() + reach &&
         p.top < q.bottom() + reach && q.top < p.bottom() + reach;
}

bool GridSearch::touch(CellIndex a, CellIndex b) const {
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    if (touch(camera, a, b)) return true;
  }
  return false;
}

ViewCells GridSearch::touching(CellIndex cell) const {
  ViewCells found(cameras_);
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    std::copy_if(seen_cells_.back().begin(), seen_cells_.back().end(),
                 std::back_inserter(found[camera]),
                 [&](CellIndex other) { return touch(camera, cell, other); });
  }
  return found;
}

}  // namespace plaza
