#include "modalities/edges/edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "plaza/core/error.h"

namespace plaza::edges {
namespace {

constexpr double kGateSigmas = 3;  // D_max = 3 R, thesis 4.3.5

const EdgeEvidence& edges_of(const Evidence& evidence) {
  const auto* edges = dynamic_cast<const EdgeEvidence*>(&evidence);
  if (edges == nullptr) throw std::invalid_argument("evidence of another modality");
  return *edges;
}

const EdgeTemplates& contours_of(const TemplateBatch& templates, const EdgeEvidence& evidence) {
  const auto* contours = dynamic_cast<const EdgeTemplates*>(&templates);
  if (contours == nullptr) throw std::invalid_argument("templates of another modality");
  if (contours->layout() != evidence.layout()) {
    throw std::invalid_argument("templates and evidence are of different cameras");
  }
  return *contours;
}

/// Nothing at all to see: a covered lens, a camera that sends one colour.
bool is_blank(const EdgeImage& image) {
  double least = 0, most = 0;
  cv::minMaxLoc(image.grey, &least, &most);
  return least == most;
}

}  // namespace

/// What a thread needs while it works on an image.
struct Edges::Workshop {
  explicit Workshop(const std::shared_ptr<const PlaneLayout>& layout)
      : transform(layout), taken(layout->size(), std::uint8_t{0}) {}
  EdgeImage image;
  FastTransform transform;
  cv::Mat1b taken;  ///< pixels that are being explained; all 0 in between
};

Edges::Edges(const Options& options, const BuildContext& context)
    : Modality(context),
      options_(options),
      shrink_(options.shrink),
      edge_options_{.method = options.method,
                    .low = options.low_threshold,
                    .high = options.high_threshold,
                    .blur_px = options.blur_px},
      segmentation_{.orientation_threshold = options.orientation_threshold,
                    .min_contour_px = options.min_contour_px,
                    .least_piece_m = options.least_piece_m,
                    .longest_line_m = options.longest_line_m,
                    .link_px = options.link_px,
                    .link_end_points = options.link_end_points},
      template_options_{.min_visible = options.min_visible,
                        .min_points = options.min_points,
                        .spans = options.explains != Explains::kContour} {
  if (options.low_threshold > options.high_threshold) {
    throw UserError(fault_at("/low_threshold", "must not be above \"high_threshold\""));
  }
  if (options.background != BackgroundMethod::kNone) {
    BackgroundOptions background;
    background.method = options.background;
    background.first = options.background_first;
    background.every = options.background_every;
    background.tolerance_px = options.background_tolerance_px;
    background.sensitivity = options.background_sensitivity;
    background.edges = edge_options_;
    learner_ = std::make_unique<BackgroundLearner>(background, context.scene, shrink_);
  }
  if (!shrink_.fits(*context.scene)) return;  // check() tells
  const std::shared_ptr<const Scene> small = shrink_(context.scene);
  const double gate_px = kGateSigmas * options.sigma_px;
  for (const Camera& camera : small->cameras) {
    View view;
    view.layout = std::make_shared<const PlaneLayout>(cv::Size(camera.width(), camera.height()),
                                                      make_directions(options.directions, gate_px));
    view.matcher = std::make_shared<const ContourMatcher>(view.layout, options.sigma_px, gate_px);
    view.blocks = Pool<EvidenceBlock>::make();
    if (options.least_piece_m > 0 || options.longest_line_m > 0) {
      view.scale =
          std::make_shared<const BodyScale>(camera, context.scene->area, context.scene->body);
    }
    views_.push_back(std::move(view));
    workshops_.push_back(Pool<Workshop>::make());
  }
}

Edges::~Edges() = default;

Diagnostics Edges::do_check() const {
  Diagnostics faults = options_.device == Device::kOpencl ? opencl::check_device() : Diagnostics();
  shrink_.check(scene(), faults);
  return faults;
}

Learner* Edges::learner() { return learner_.get(); }

Pool<EvidenceBlock>::Handle Edges::take_block(const View& view) const {
  return view.blocks->take([&] { return std::make_unique<EvidenceBlock>(*view.layout); });
}

const Edges::View& Edges::view_of(const EdgeEvidence& evidence) const {
  for (const View& view : views_) {
    if (view.layout == evidence.layout()) return view;
  }
  throw std::invalid_argument("evidence of another modality");
}

Modality::Prepared Edges::do_prepare(const cv::Mat& image, std::size_t camera,
                                     const Past& /*past*/) const {
  const View& view = views_[camera];
  std::shared_ptr<const ViewBackground> background;
  if (learner_ != nullptr) {
    background = learner_->view(camera);
    if (background == nullptr) throw InternalError("the background has not been learned");
  }
  const auto workshop =
      workshops_[camera]->take([&] { return std::make_unique<Workshop>(view.layout); });
  find_edges(shrink_(image), edge_options_, workshop->image);

  auto block = take_block(view);
  block->labels.clear();
  const bool unknown = background != nullptr && !background->known;
  segment(workshop->image, unknown ? nullptr : background.get(), segmentation_, block->labels,
          block->points, view.scale.get());
  workshop->transform.run(block->points, block->planes);
  const bool blank = unknown || is_blank(workshop->image);
  return {std::make_shared<const EdgeEvidence>(view.layout, std::move(background), std::move(block),
                                               blank, shrink_),
          {}};
}

std::unique_ptr<TemplateBatch> Edges::do_sample(const ShapeModel& model,
                                                std::span<const Pose> poses,
                                                std::size_t camera) const {
  auto templates = std::make_unique<EdgeTemplates>(views_[camera].layout);
  for (const Pose& pose : poses) {
    templates->add(shrink_(model.silhouette(pose, scene().cameras[camera])), template_options_);
  }
  return templates;
}

void Edges::do_match(const Evidence& evidence, const TemplateBatch& templates,
                     std::span<const std::uint32_t> which, std::span<double> log_likelihood) const {
  const EdgeEvidence& edges = edges_of(evidence);
  const EdgeTemplates& contours = contours_of(templates, edges);
  const ContourMatcher& matcher = *view_of(edges).matcher;
  const std::uint8_t* planes = edges.block().planes.data();
  Memo<double>& memo = edges.matched(contours);
  if (options_.device == Device::kOpencl && which.size() >= opencl::kLeastTemplates &&
      !edges.explained() && !edges.blank()) {
    const auto& device = device_.get([] { return std::make_unique<const OpenclMatcher>(); });
    const std::vector<ContourSum> sums = device->sums(
        edges.on_device().get([&] { return OpenclMatcher::upload(edges.block().planes); }),
        contours, which);
    const std::size_t directions = sums.size() / which.size();
    for (std::size_t i = 0; i < which.size(); ++i) {
      log_likelihood[i] =
          contours.tells(which[i])
              ? matcher.log_likelihood_of(std::span(sums).subspan(i * directions, directions),
                                          contours.points(which[i]))
              : std::numeric_limits<double>::quiet_NaN();
      memo.keep(which[i], log_likelihood[i]);
    }
    return;
  }
  PatchedSums patched(planes, edges.patches(), matcher.sum_pieces());
  std::vector<ContourSum> sums(edges.layout()->directions().size());
  for (std::size_t i = 0; i < which.size(); ++i) {
    const std::uint32_t index = which[i];
    // asked for while the one before is summed up: the planes of all directions fill no near cache
    if (i + 1 < which.size() && !edges.explained() && !memo.knows(which[i + 1])) {
      ContourMatcher::fetch(planes, contours, which[i + 1]);
    }
    log_likelihood[i] = std::numeric_limits<double>::quiet_NaN();
    if (edges.blank() || !contours.tells(index)) continue;
    if (edges.hidden() != nullptr) {
      const auto found = matcher.log_likelihood(planes, *edges.hidden(), contours, index,
                                                options_.min_visible, options_.min_points);
      if (found) log_likelihood[i] = *found;
    } else if (patched.touches(contours, index)) {
      patched.sum(contours, index, sums.data());
      log_likelihood[i] = matcher.log_likelihood_of(sums, contours.points(index));
    } else {
      if (!memo.knows(index)) {
        log_likelihood[i] = matcher.log_likelihood(planes, contours, index);
        memo.keep(index, log_likelihood[i]);
      } else {
        log_likelihood[i] = memo.at(index);
      }
    }
  }
}

EvidencePtr Edges::do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                              std::span<const std::uint32_t> which) const {
  const EdgeEvidence& before = edges_of(*evidence);
  const EdgeTemplates& contours = contours_of(templates, before);
  const View& view = view_of(before);
  if (options_.explains == Explains::kRegion) {
    auto hidden = before.hidden() != nullptr ? std::make_shared<HiddenRegion>(*before.hidden())
                                             : std::make_shared<HiddenRegion>(*view.layout);
    for (const std::uint32_t index : which) {
      hidden->add(contours.spans(index),
                  static_cast<int>(std::ceil(kGateSigmas * options_.sigma_px)));
    }
    return std::make_shared<const EdgeEvidence>(before, std::move(hidden));
  }
  const std::size_t camera = static_cast<std::size_t>(&view - views_.data());
  const auto workshop =
      workshops_[camera]->take([&] { return std::make_unique<Workshop>(view.layout); });
  EdgeEvidence::Left left;
  left.points.assign(before.points().begin(), before.points().end());
  std::vector<cv::Rect> removed;
  Memo<EdgeEvidence::PointsPtr>& memo = before.accounted(contours);
  for (const std::uint32_t index : which) {
    EdgeEvidence::PointsPtr points =
        memo.knows(index) ? memo.at(index) : accounted_for(before, contours, index, *workshop);
    memo.keep(index, points);
    const cv::Rect box = take_away(*points, *workshop, left.points);
    if (!box.empty()) removed.push_back(box);
  }
  left.patches = patched(*view.layout, {before.patches().begin(), before.patches().end()}, removed,
                         left.points, workshop->transform);
  return std::make_shared<const EdgeEvidence>(before, std::move(left));
}

cv::Rect Edges::take_away(std::span<const EdgePoint> gone, Workshop& workshop,
                          std::vector<EdgePoint>& points) {
  for (const EdgePoint p : gone) workshop.taken(p.y, p.x) = 1;
  cv::Rect box;
  std::erase_if(points, [&](const EdgePoint p) {
    if (workshop.taken(p.y, p.x) == 0) return false;
    box |= cv::Rect(p.x, p.y, 1, 1);
    return true;
  });
  for (const EdgePoint p : gone) workshop.taken(p.y, p.x) = 0;
  return box;
}

EdgeEvidence::PointsPtr Edges::accounted_for(const EdgeEvidence& evidence,
                                             const EdgeTemplates& contours, std::size_t index,
                                             Workshop& workshop) {
  const PlaneLayout& layout = *evidence.layout();
  const LabelImage& labels = evidence.block().labels;
  auto marked = std::make_shared<std::vector<EdgePoint>>();
  const auto mark = [&](int x, int y) {
    if ((labels.at(x, y) & kForeground) == 0 || workshop.taken(y, x) != 0) return;
    workshop.taken(y, x) = 1;
    marked->push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
  };
  // along the normal, which is a line of the direction, to both sides
  const auto mark_normal = [&](std::size_t d, cv::Point p) {
    const Direction& direction = layout.directions()[d];
    const cv::Size size = layout.size();
    const int rows = direction.steep ? size.height : size.width;
    const int columns = direction.steep ? size.width : size.height;
    const int row = direction.steep ? p.y : p.x, column = direction.steep ? p.x : p.y;
    const auto mark_at = [&](int r, int c) {
      if (c >= 0 && c < columns) direction.steep ? mark(c, r) : mark(r, c);
    };
    int c = column;
    for (int r = row; r < std::min(row + direction.gate + 1, rows); ++r) {
      if (r > row) c += workshop.transform.drift(d, r);
      mark_at(r, c);
    }
    c = column;
    for (int r = row - 1; r >= std::max(row - direction.gate, 0); --r) {
      c -= workshop.transform.drift(d, r + 1);
      mark_at(r, c);
    }
  };
  const ContourRuns runs = contours.runs(index);
  std::size_t run = 0;
  for (std::size_t d = 0; d < runs.directions; ++d) {
    for (const std::size_t end = run + runs.counts[d]; run < end; ++run) {
      for (std::uint32_t i = 0; i < runs.lengths[run]; ++i) {
        mark_normal(d, layout.pixel(d, runs.begins[run] + i));
      }
    }
  }
  for (const RowSpan& span : contours.spans(index)) {
    for (int x = span.begin; x < span.end; ++x) mark(x, span.row);
  }
  for (const EdgePoint p : *marked) workshop.taken(p.y, p.x) = 0;
  return marked;
}

}  // namespace plaza::edges
