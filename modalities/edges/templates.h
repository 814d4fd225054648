#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "modalities/common/memo.h"
#include "modalities/common/opencl.h"
#include "modalities/edges/contour_sums.h"
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

/// Templates of one view on an OpenCL device.
struct DeviceContours {
  cv::UMat begins, lengths;  ///< [run]
  cv::UMat firsts;           ///< [template * directions + direction] first run, and one more
  cv::UMat peaks;            ///< [direction]
};

/// Silhouette contours of one view, as the runs of bytes that they read in a block of planes:
/// template by template, in each by direction, in each direction by rising index. A byte that
/// several contour points fall on is in as many runs.
class EdgeTemplates final : public TemplateBatch {
 public:
  explicit EdgeTemplates(std::shared_ptr<const PlaneLayout> layout);

  /// Appends a silhouette. Contour points outside the image aren't kept.
  void add(const Silhouette& silhouette, const TemplateOptions& options);

  std::size_t size() const override { return points_.size(); }
  const std::shared_ptr<const PlaneLayout>& layout() const { return layout_; }

  /// False: too little of the template is in this view to tell anything.
  bool tells(std::size_t index) const { return tells_[index] != 0; }
  /// Number of contour points in the image.
  std::uint32_t points(std::size_t index) const { return points_[index]; }
  ContourRuns runs(std::size_t index) const {
    const std::size_t directions = peaks_.size();
    return {begins_.data() + first_run_[index], lengths_.data() + first_run_[index],
            counts_.data() + index * directions, peaks_.data(), directions};
  }
  /// [run] the row of the plane that it lies in.
  std::span<const std::uint16_t> rows(std::size_t index) const {
    return {rows_.data() + first_run_[index], rows_.data() + first_run_[index + 1]};
  }
  /// Around all its points, in pixels.
  const cv::Rect& box(std::size_t index) const { return boxes_[index]; }
  /// Those of all templates, one behind the other.
  ContourRuns all_runs() const {
    return {begins_.data(), lengths_.data(), counts_.data(), peaks_.data(), peaks_.size()};
  }
  std::span<const std::uint32_t> all_counts() const { return counts_; }
  const BatchSerial& serial() const { return serial_; }
  /// The same on the OpenCL device, made when first asked for; no template may be added then.
  const opencl::OnDevice<DeviceContours>& on_device() const { return on_device_; }
  /// First bytes of all its runs.
  std::span<const std::uint32_t> begins(std::size_t index) const {
    return {begins_.data() + first_run_[index], begins_.data() + first_run_[index + 1]};
  }
  /// Rows of its inside; empty unless TemplateOptions::spans.
  std::span<const RowSpan> spans(std::size_t index) const {
    if (span_begins_.size() <= 1) return {};
    return {spans_.data() + span_begins_[index], spans_.data() + span_begins_[index + 1]};
  }

 private:
  std::shared_ptr<const PlaneLayout> layout_;
  std::vector<std::uint8_t> peaks_;        ///< [direction]
  std::vector<std::uint32_t> begins_;      ///< [run]
  std::vector<std::uint8_t> lengths_;      ///< [run]
  std::vector<std::uint16_t> rows_;        ///< [run]
  std::vector<cv::Rect> boxes_;            ///< [template]
  std::vector<std::uint32_t> counts_;      ///< [template * directions + direction] runs
  std::vector<std::size_t> first_run_{0};  ///< [template], and the number of all
  std::vector<std::uint32_t> points_;      ///< [template]
  std::vector<std::uint8_t> tells_;        ///< [template]
  std::vector<RowSpan> spans_;
  std::vector<std::size_t> span_begins_{0};
  BatchSerial serial_;
  opencl::OnDevice<DeviceContours> on_device_;
};

/// Log-likelihood (4.3) of templates over one block of planes:
/// -sum min(DT^2, D_max^2) / (2 N R^2), in [-D_max^2 / (2 R^2), 0].
///
/// Distances are whole steps, so that per direction their squares are summed up without rounding
/// (ContourSum); the order of points and the instruction set make no difference.
class ContourMatcher {
 public:
  /// `sigma_px` is R, `gate_px` D_max.
  ContourMatcher(std::shared_ptr<const PlaneLayout> layout, double sigma_px, double gate_px,
                 const SumContourVersion& version = sum_contour_versions().back());

  /// Begins to bring what a template reads into the cache.
  static void fetch(const std::uint8_t* block, const EdgeTemplates& templates, std::size_t index);
  /// The template must tell something.
  double log_likelihood(const std::uint8_t* block, const EdgeTemplates& templates,
                        std::size_t index) const;
  SumPieces sum_pieces() const { return version_->run_pieces; }
  /// By the points that aren't hidden; nothing when they are less than `least_share` of all, or
  /// fewer than `least_points`.
  std::optional<double> log_likelihood(const std::uint8_t* block, const HiddenRegion& hidden,
                                       const EdgeTemplates& templates, std::size_t index,
                                       double least_share, int least_points) const;

  /// From the sums of all directions over so many points.
  double log_likelihood_of(std::span<const ContourSum> sums, std::uint64_t points) const;

 private:
  std::shared_ptr<const PlaneLayout> layout_;
  double sigma_px_, gate_px_;
  const SumContourVersion* version_;
};

}  // namespace plaza::edges
