#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "plaza/component/models.h"
#include "plaza/geometry/scene.h"
#include "plugins/detectors/hierarchical-grid/state_grid.h"

namespace plaza {

/// The silhouettes of the model in all cells of one level that one camera sees.
struct LevelTemplates {
  std::vector<CellIndex> cells;      ///< that the camera sees, rising
  std::vector<std::size_t> offsets;  ///< of their silhouettes in `bytes`
  std::string bytes;                 ///< see silhouette_codec.h
};

/// The template hierarchy of thesis 4.3.1: the model at the centre of every cell of every level,
/// seen by every camera, where it can be seen.
class TemplateHierarchy {
 public:
  /// `grid` and `scene` are kept by reference and must outlive the hierarchy.
  TemplateHierarchy(const StateGrid& grid, const Scene& scene) : grid_(&grid), scene_(&scene) {}

  /// Projects the model everywhere; what the scene's occluders hide is left out where
  /// `use_occluders`. A camera sees a cell when at least `min_inside` of the silhouette's area is
  /// in its image and not hidden.
  void compute(const ShapeModel& model, double min_inside, bool use_occluders);
  const LevelTemplates& templates(std::size_t camera, std::size_t level) const {
    return views_[camera][level];
  }

  void save(std::ostream& out) const;
  /// Restores what save() wrote for the same grid and as many cameras. Throws Error when it is
  /// anything else; the hierarchy is unchanged then.
  void load(std::istream& in);

 private:
  void check(const LevelTemplates& templates, std::size_t level) const;

  const StateGrid* grid_;
  const Scene* scene_;
  std::vector<std::vector<LevelTemplates>> views_;  ///< [camera][level]
};

/// Serves stored silhouettes of one level in one view to modalities; asks the model itself for any
/// other pose.
class StoredShape final : public ShapeModel {
 public:
  /// All arguments must outlive the shape.
  StoredShape(const ShapeModel& model, const StateGrid& grid, std::size_t level,
              const LevelTemplates& templates)
      : model_(&model), grid_(&grid), level_(level), templates_(&templates) {}

 private:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override;
  Body do_body() const override { return model_->body(); }

  const ShapeModel* model_;
  const StateGrid* grid_;
  std::size_t level_;
  const LevelTemplates* templates_;
};

}  // namespace plaza
