#pragma once

#include <iosfwd>
#include <memory>
#include <span>
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

/// Cells of one level with bodies of one size.
struct TemplateLayer {
  std::size_t level = 0;
  double scale = 1;  ///< of the body relative to the model's own size
};

/// The template hierarchy of thesis 4.3.1: the model at the centre of every cell of every level,
/// seen by every camera, where it can be seen; on the finest level in several sizes.
class TemplateHierarchy {
 public:
  /// `other_scales`: of bodies on the finest level beside the model's own size. `grid` and `scene`
  /// are kept by reference and must outlive the hierarchy.
  TemplateHierarchy(const StateGrid& grid, const Scene& scene,
                    std::span<const double> other_scales = {});

  /// One per level in the model's own size, coarse to fine, then those of other sizes.
  std::span<const TemplateLayer> layers() const { return layers_; }

  /// Projects the model everywhere; what the scene's occluders hide is left out where
  /// `use_occluders`. A camera sees a cell when at least `min_inside` of the silhouette's area is
  /// in its image and not hidden.
  void compute(const ShapeModel& model, double min_inside, bool use_occluders);
  const LevelTemplates& templates(std::size_t camera, std::size_t layer) const {
    return views_[camera][layer];
  }

  void save(std::ostream& out) const;
  /// Restores what save() wrote for the same grid and as many cameras. Throws Error when it is
  /// anything else; the hierarchy is unchanged then.
  void load(std::istream& in);

 private:
  const StateGrid* grid_;
  const Scene* scene_;
  std::vector<TemplateLayer> layers_;
  std::vector<std::vector<LevelTemplates>> views_;  ///< [camera][layer]
};

/// Serves stored silhouettes of one layer in one view to modalities; asks the model itself for any
/// other pose.
class StoredShape final : public ShapeModel {
 public:
  /// All arguments must outlive the shape.
  StoredShape(const ShapeModel& model, const StateGrid& grid, const TemplateLayer& layer,
              const LevelTemplates& templates)
      : model_(&model), grid_(&grid), layer_(layer), templates_(&templates) {}

 private:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override;
  Body do_body() const override { return model_->body(); }

  const ShapeModel* model_;
  const StateGrid* grid_;
  TemplateLayer layer_;
  const LevelTemplates* templates_;
};

}  // namespace plaza
