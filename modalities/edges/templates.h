#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modalities/edges/fast_transform.h"
#include "modalities/edges/hidden_region.h"
#include "plaza/component/modality.h"
#include "plaza/component/models.h"

namespace plaza::edges {

struct TemplateOptions {
  double min_visible = 0.3;  ///< least share of a silhouette inside the image
  int min_points = 20;       ///< least number of contour points inside the image
  bool spans = false;        ///< whether explain() needs the inside
};

/// Silhouette contours of one view, as the indices of the bytes that they read in a block of
/// planes: template by template, in each by direction, in each direction by rising index.
class EdgeTemplates final : public TemplateBatch {
 public:
  explicit EdgeTemplates(std::shared_ptr<const PlaneLayout> layout) : layout_(std::move(layout)) {}

  /// Appends a silhouette. Contour points outside the image aren't kept.
  void add(const Silhouette& silhouette, const TemplateOptions& options);

  std::size_t size() const override { return begins_.size() - 1; }
  const std::shared_ptr<const PlaneLayout>& layout() const { return layout_; }

  /// False: too little of the template is in this view to tell anything.
  bool tells(std::size_t index) const { return tells_[index] != 0; }
  /// All points of a template.
  std::span<const std::uint32_t> points(std::size_t index) const {
    return {points_.data() + begins_[index], points_.data() + begins_[index + 1]};
  }
  /// How many of its points belong to each direction, in their order.
  std::span<const std::uint32_t> runs(std::size_t index) const {
    const std::size_t count = layout_->directions().size();
    return {runs_.data() + index * count, count};
  }
  /// Rows of its inside; empty unless TemplateOptions::spans.
  std::span<const RowSpan> spans(std::size_t index) const {
    if (span_begins_.size() <= 1) return {};
    return {spans_.data() + span_begins_[index], spans_.data() + span_begins_[index + 1]};
  }

 private:
  std::shared_ptr<const PlaneLayout> layout_;
  std::vector<std::uint32_t> points_, runs_;
  std::vector<std::size_t> begins_{0}, span_begins_{0};
  std::vector<std::uint8_t> tells_;
  std::vector<RowSpan> spans_;
};

/// Log-likelihood (4.3) of templates over one block of planes:
/// -sum min(DT^2, D_max^2) / (2 N R^2), in [-D_max^2 / (2 R^2), 0].
///
/// Distances are whole steps, so that per direction their squares are summed up without rounding:
/// one table look-up per point gives the square in the low half of a 64-bit word and, beyond the
/// gate, a one in the high half.
class ContourMatcher {
 public:
  /// `sigma_px` is R, `gate_px` D_max.
  ContourMatcher(std::shared_ptr<const PlaneLayout> layout, double sigma_px, double gate_px);

  /// The template must tell something.
  double log_likelihood(const std::uint8_t* block, const EdgeTemplates& templates,
                        std::size_t index) const;
  /// By the points that aren't hidden; nothing when they are less than `least_share` of all, or
  /// fewer than `least_points`.
  std::optional<double> log_likelihood(const std::uint8_t* block, const HiddenRegion& hidden,
                                       const EdgeTemplates& templates, std::size_t index,
                                       double least_share, int least_points) const;

 private:
  struct Table {
    std::uint64_t of[256];  ///< by nearness
  };
  std::shared_ptr<const PlaneLayout> layout_;
  double sigma_px_, gate_px_;
  std::vector<Table> tables_;             ///< one per different gate
  std::vector<std::size_t> table_index_;  ///< by direction
};

}  // namespace plaza::edges
