#include "plugins/detectors/hierarchical-grid/template_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>

#include "plaza/core/error.h"
#include "plaza/core/parallel.h"
#include "plugins/detectors/hierarchical-grid/occlusion.h"
#include "plugins/detectors/hierarchical-grid/silhouette_codec.h"

namespace plaza {
namespace {

constexpr std::string_view kMagic = "plaza template hierarchy 2\n";
constexpr std::size_t kCellsPerTask = 64;  ///< cells that one task projects

void write(std::ostream& out, std::uint64_t value) {
  std::string bytes;
  for (unsigned i = 0; i < 8; ++i) {
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(value >> (8 * i))));
  }
  out << bytes;
}

std::uint64_t read(std::istream& in) {
  std::string bytes(8, '\0');
  if (!in.read(bytes.data(), 8)) throw Error("the stored template hierarchy ends early");
  std::uint64_t value = 0;
  for (unsigned i = 0; i < 8; ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return value;
}

std::string read_bytes(std::istream& in, std::uint64_t size) {
  // by pieces: a damaged length must not ask for all memory there is
  std::string bytes;
  while (bytes.size() < size) {
    const std::size_t begin = bytes.size();
    bytes.resize(begin + std::min<std::uint64_t>(size - begin, std::uint64_t{1} << 20));
    if (!in.read(bytes.data() + begin, static_cast<std::streamsize>(bytes.size() - begin))) {
      throw Error("the stored template hierarchy ends early");
    }
  }
  return bytes;
}

}  // namespace

TemplateHierarchy::TemplateHierarchy(const StateGrid& grid, const Scene& scene,
                                     std::span<const double> other_scales)
    : grid_(&grid), scene_(&scene) {
  for (std::size_t level = 0; level < grid.levels(); ++level) layers_.push_back({level, 1});
  for (const double scale : other_scales) layers_.push_back({grid.levels() - 1, scale});
}

void TemplateHierarchy::compute(const ShapeModel& model, double min_inside, bool use_occluders) {
  views_.assign(scene_->cameras.size(), std::vector<LevelTemplates>(layers_.size()));
  for (std::size_t camera = 0; camera < views_.size(); ++camera) {
    std::vector<OccluderPolygon> occluders;
    for (const StaticOccluder& o : scene_->occluders) {
      if (use_occluders && o.camera == scene_->cameras[camera].name()) {
        occluders.push_back(o.polygon_px);
      }
    }
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
      const auto [level, scale] = layers_[layer];
      const std::size_t cells = grid_->size(level);
      std::vector<LevelTemplates> parts((cells + kCellsPerTask - 1) / kCellsPerTask);
      parallel_for(parts.size(), [&, level = level, scale = scale](std::size_t part) {
        LevelTemplates& out = parts[part];
        for (std::size_t i = part * kCellsPerTask; i < std::min(cells, (part + 1) * kCellsPerTask);
             ++i) {
          const auto cell = static_cast<CellIndex>(i);
          Silhouette s =
              model.silhouette({grid_->position(level, cell), 0, scale}, scene_->cameras[camera]);
          if (!occluders.empty()) s = without_hidden(s, occluders);
          if (s.spans.empty() || s.inside_share < min_inside) continue;
          out.cells.push_back(cell);
          out.offsets.push_back(out.bytes.size());
          encode(s, out.bytes);
        }
      });
      LevelTemplates& all = views_[camera][layer];
      for (const LevelTemplates& part : parts) {
        all.cells.insert(all.cells.end(), part.cells.begin(), part.cells.end());
        for (const std::size_t offset : part.offsets) {
          all.offsets.push_back(all.bytes.size() + offset);
        }
        all.bytes += part.bytes;
      }
    }
  }
}

void TemplateHierarchy::save(std::ostream& out) const {
  out << kMagic;
  write(out, views_.size());
  write(out, layers_.size());
  for (const std::vector<LevelTemplates>& view : views_) {
    for (const LevelTemplates& layer : view) {
      write(out, layer.cells.size());
      for (const CellIndex cell : layer.cells) write(out, cell);
      write(out, layer.bytes.size());
      out << layer.bytes;
    }
  }
}

void TemplateHierarchy::load(std::istream& in) {
  if (read_bytes(in, kMagic.size()) != kMagic) throw Error("this is no stored template hierarchy");
  if (read(in) != scene_->cameras.size() || read(in) != layers_.size()) {
    throw Error("the stored template hierarchy is for other cameras, levels or sizes");
  }
  std::vector<std::vector<LevelTemplates>> views(scene_->cameras.size());
  for (std::vector<LevelTemplates>& view : views) {
    for (const auto& [level, scale] : layers_) {
      LevelTemplates t;
      const std::uint64_t count = read(in);
      if (count > grid_->size(level)) {
        throw Error("the stored template hierarchy has more cells than the grid");
      }
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t cell = read(in);
        if (cell >= grid_->size(level) || (!t.cells.empty() && cell <= t.cells.back())) {
          throw Error("the stored template hierarchy names cells that the grid lacks");
        }
        t.cells.push_back(static_cast<CellIndex>(cell));
      }
      t.bytes = read_bytes(in, read(in));
      std::size_t at = 0;
      for (std::uint64_t i = 0; i < count; ++i) {
        t.offsets.push_back(at);
        decode(t.bytes, at);
      }
      if (at != t.bytes.size()) throw Error("the stored template hierarchy has spare silhouettes");
      view.push_back(std::move(t));
    }
  }
  if (in.peek() != std::istream::traits_type::eof()) {
    throw Error("the stored template hierarchy goes on after its end");
  }
  views_ = std::move(views);
}

Silhouette StoredShape::do_silhouette(const Pose& pose, const Camera& camera) const {
  const GroundGrid& grid = grid_->grid(layer_.level);
  const Eigen::Vector2d at = (pose.position_m - grid.origin_m).cwiseQuotient(grid.step_m);
  const double column = std::round(at.x()), row = std::round(at.y());
  const bool on_grid = pose.heading_rad == 0 && pose.scale == layer_.scale && column >= 0 &&
                       row >= 0 && column < grid.columns && row < grid.rows;
  if (on_grid) {
    const auto cell = static_cast<CellIndex>(row * grid.columns + column);
    const auto found = std::lower_bound(templates_->cells.begin(), templates_->cells.end(), cell);
    const bool stored = found != templates_->cells.end() && *found == cell;
    if (stored && grid_->position(layer_.level, cell) == pose.position_m) {
      std::size_t offset =
          templates_->offsets[static_cast<std::size_t>(found - templates_->cells.begin())];
      return decode(templates_->bytes, offset);
    }
  }
  return model_->silhouette(pose, camera);
}

}  // namespace plaza
