#include "modalities/color/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "modalities/color/cast_shadow.h"
#include "modalities/color/opencl_segmenter.h"
#include "modalities/common/opencl.h"
#include "plaza/core/parallel.h"

namespace plaza {
namespace {

using color::ColorEvidence;

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// What the scene's static occluders hide in this view.
std::shared_ptr<const ColorEvidence::Blind> occluded(const Scene& scene, const Camera& camera) {
  auto blind = std::make_shared<ColorEvidence::Blind>();
  for (const StaticOccluder& occluder : scene.occluders) {
    if (occluder.camera != camera.name()) continue;
    if (blind->mask.empty()) {
      blind->mask = cv::Mat(camera.height(), camera.width(), CV_8UC1, cv::Scalar(0));
    }
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& p : occluder.polygon_px) {
      corners.emplace_back(static_cast<int>(std::lround(p.x())),
                           static_cast<int>(std::lround(p.y())));
    }
    cv::fillPoly(blind->mask, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255));
  }
  if (!blind->mask.empty()) blind->counts = color::AreaCounts(blind->mask);
  return blind;
}

/// log L = scale * (1 - occupancy)^2
double scale_of(double occupancy_sigma) { return -0.5 / (occupancy_sigma * occupancy_sigma); }

}  // namespace

ColorModality::ColorModality(const Options& options, const BuildContext& context)
    : Modality(context),
      options_(options),
      shrink_(options.shrink),
      parts_(read_body_parts(options.parts)),
      learners_(context.scene->cameras.size(),
                color::BackgroundLearner(static_cast<std::size_t>(options.background_samples))) {
  if (shrink_.fits(*context.scene)) small_ = shrink_(context.scene);  // else check() tells
  if (!parts_.empty()) {
    in_parts_.emplace(color::PartJudgement{.mixture = PartMixture(parts_),
                                           .least_visible = options.least_visible,
                                           .scale = scale_of(options.occupancy_sigma)});
  }
}

Diagnostics ColorModality::do_check() const {
  Diagnostics faults = options_.device == Device::kOpencl ? opencl::check_device() : Diagnostics();
  shrink_.check(scene(), faults);
  return faults;
}

Modality::Prepared ColorModality::do_prepare(const cv::Mat& full, std::size_t camera,
                                             const Past& past) const {
  if (views_.empty()) throw InternalError("the background has not been learned yet");
  const cv::Mat image = shrink_(full);
  const View& view = views_[camera];
  if (!view.ground) {
    return {std::make_shared<ColorEvidence>(ColorEvidence::State::kNoBackground, image,
                                            color::Segmentation(), nullptr, view.blind, shrink_),
            cv::Mat()};
  }
  color::Segmented seen =
      color::segment_living(image, past, view.ground, 1 / scene().frame_rate_hz, living(),
                            [this](color::Background b) { return make_ground(std::move(b)); });
  color::Segmentation& segmentation = seen.segmentation;
  if (view.scale && options_.most_shadow_m > 0) {
    segmentation.mask =
        color::without_shadows(segmentation.mask, image, seen.ground->background->image,
                               *view.scale, options_.most_shadow_m);
  }
  if (view.scale) segmentation.mask = color::analysed(segmentation.mask, *view.scale, shapes());
  const double share =
      cv::countNonZero(segmentation.mask) / static_cast<double>(segmentation.mask.total());
  const bool usable = share <= options_.most_foreground;
  const cv::Mat mask = usable ? segmentation.mask : cv::Mat();
  return {std::make_shared<ColorEvidence>(
              usable ? ColorEvidence::State::kUsable : ColorEvidence::State::kOtherBackground,
              image, std::move(segmentation), seen.ground->background, view.blind, shrink_),
          shrink_.back(mask), std::move(seen.memory)};
}

std::unique_ptr<TemplateBatch> ColorModality::do_sample(const ShapeModel& model,
                                                        std::span<const Pose> poses,
                                                        std::size_t camera) const {
  const Camera& c = small_->cameras[camera];
  auto batch = std::make_unique<color::SpanTemplates>(cv::Size(c.width(), c.height()),
                                                      std::max<std::size_t>(parts_.size(), 1));
  const color::RingShape ring{.gap = options_.gap, .width = options_.ring};
  for (const Pose& pose : poses) {
    const Silhouette silhouette = shrink_(model.silhouette(pose, scene().cameras[camera]));
    if (parts_.empty()) {
      batch->add(silhouette, ring);
    } else {
      batch->add(silhouette, ring, BodyCuts(parts_, model.body(), pose, c));
    }
  }
  return batch;
}

void ColorModality::do_match(const Evidence& evidence, const TemplateBatch& templates,
                             std::span<const std::uint32_t> which,
                             std::span<double> log_likelihood) const {
  const auto& seen = static_cast<const ColorEvidence&>(evidence);
  const auto& batch = static_cast<const color::SpanTemplates&>(templates);
  if (in_parts_) return match_parts(seen, batch, which, log_likelihood);
  const double scale = scale_of(options_.occupancy_sigma);
  const auto value = [&](const std::optional<double>& occupancy) {
    return occupancy ? scale * (1 - *occupancy) * (1 - *occupancy)
                     : std::numeric_limits<double>::quiet_NaN();
  };
  ColorEvidence::CountMemo& memo = seen.counted(batch);
  if (counter_ && which.size() >= opencl::kLeastTemplates && seen.countable_on_device()) {
    const std::vector<color::TemplateCounts> counts = seen.count(*counter_, batch, which);
    for (std::size_t i = 0; i < which.size(); ++i) {
      memo.keep(which[i], counts[i]);
      log_likelihood[i] =
          value(color::occupancy(batch.at(which[i]), counts[i], options_.least_visible));
    }
    return;
  }
  for (std::size_t i = 0; i < which.size(); ++i) {
    log_likelihood[i] = value(seen.occupancy(batch, which[i], options_.least_visible, memo));
  }
}

void ColorModality::match_parts(const ColorEvidence& seen, const color::SpanTemplates& batch,
                                std::span<const std::uint32_t> which,
                                std::span<double> log_likelihood) const {
  std::fill(log_likelihood.begin(), log_likelihood.end(), std::numeric_limits<double>::quiet_NaN());
  if (seen.state() != ColorEvidence::State::kUsable) return;
  ColorEvidence::CountMemo& memo = seen.counted(batch);
  const std::size_t parts = batch.parts();
  if (counter_ && which.size() >= opencl::kLeastTemplates && seen.countable_on_device()) {
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t body : which) {
      for (std::size_t k = 0; k < parts; ++k) {
        pieces.push_back(static_cast<std::uint32_t>(body * parts + k));
      }
    }
    const std::vector<color::TemplateCounts> counts = seen.count(*counter_, batch, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) memo.keep(pieces[i], counts[i]);
  }
  std::array<color::TemplateCounts, kMostBodyParts> counts;
  for (std::size_t i = 0; i < which.size(); ++i) {
    for (std::size_t k = 0; k < parts; ++k) {
      counts[k] = seen.left(batch, which[i] * parts + k, memo);
    }
    const auto found = color::log_likelihood_in_parts(batch, which[i], counts, *in_parts_);
    if (found) log_likelihood[i] = *found;
  }
}

EvidencePtr ColorModality::do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                                      std::span<const std::uint32_t> which) const {
  const auto& seen = static_cast<const ColorEvidence&>(*evidence);
  if (seen.state() != ColorEvidence::State::kUsable) return evidence;
  return seen.without(static_cast<const color::SpanTemplates&>(templates), which);
}

std::optional<LearningPlan> ColorModality::do_plan() const {
  LearningPlan plan;
  plan.people_free_only = options_.background == Learning::kPeopleFree;
  plan.first = options_.background_first;
  plan.every = options_.background_every;
  return plan;
}

void ColorModality::do_learn(const FrameSet& frames) {
  for (std::size_t c = 0; c < frames.views.size(); ++c) {
    const cv::Mat& image = frames.views[c];
    if (image.empty()) continue;
    const Camera& camera = scene().cameras.at(c);
    if (image.cols != camera.width() || image.rows != camera.height() || image.type() != CV_8UC3) {
      UserError error("image is " + size_text(image.cols, image.rows) +
                      ", the calibration of camera '" + camera.name() + "' is for " +
                      size_text(camera.width(), camera.height()) + " BGR");
      error.add_context({.component = {}, .frame = {}, .camera = camera.name()});
      throw error;
    }
    learners_[c].add(shrink_(image));
  }
}

void ColorModality::do_finish(std::int64_t seen) {
  std::size_t known = 0;
  std::vector<color::Background> backgrounds(learners_.size());
  for (std::size_t c = 0; c < learners_.size(); ++c) {
    backgrounds[c] = learners_[c].background();
    known += backgrounds[c].empty() ? 0 : 1;
    learners_[c] = color::BackgroundLearner(static_cast<std::size_t>(options_.background_samples));
  }
  if (known == 0) {
    std::string text = "the background needs at least one frame with an image, but ";
    text += seen == 0 && options_.background == Learning::kPeopleFree
                ? "the source marks none as free of people; mark some, or learn from frames with "
                  "people (\"background\": \"median\")"
                : "of " + std::to_string(seen) + " frames none has one";
    throw UserError(text);
  }
  use(std::move(backgrounds));
}

void ColorModality::do_save(std::ostream& out) const {
  std::vector<color::Background> backgrounds;
  for (const View& view : views_) {
    backgrounds.push_back(view.ground ? *view.ground->background : color::Background());
  }
  color::save_backgrounds(backgrounds, out);
}

void ColorModality::do_load(std::istream& in) {
  std::vector<color::Background> backgrounds = color::load_backgrounds(in);
  if (backgrounds.size() != scene().cameras.size()) {
    throw UserError("the stored background is of " + std::to_string(backgrounds.size()) +
                    " views, the scene has " + std::to_string(scene().cameras.size()) +
                    "; it has to be learned again");
  }
  for (std::size_t c = 0; c < backgrounds.size(); ++c) {
    const cv::Mat& image = backgrounds[c].image;
    const Camera& camera = small_->cameras[c];
    if (image.empty() || (image.cols == camera.width() && image.rows == camera.height())) continue;
    throw UserError("the stored background of camera '" + camera.name() + "' is " +
                    size_text(image.cols, image.rows) + ", images are looked at in " +
                    size_text(camera.width(), camera.height()) + "; it has to be learned again");
  }
  use(std::move(backgrounds));
}

color::LivingOptions ColorModality::living() const {
  color::LivingOptions options;
  options.follow_light = options_.follow_light;
  options.light.rate_per_s = options_.light_rate;
  if (options_.settle_s) options.settling = color::SettlingOptions{.after_s = *options_.settle_s};
  return options;
}

color::ShapeOptions ColorModality::shapes() const {
  return {.least_height_m = options_.least_height_m,
          .least_column_m = options_.least_column_m,
          .most_hole = options_.most_hole};
}

std::shared_ptr<const color::Ground> ColorModality::make_ground(
    color::Background background) const {
  const color::CriterionOptions criterion_options{.darkness = options_.darkness,
                                                  .least_noise_px = options_.least_noise};
  const color::LabelFieldOptions field{.threshold = options_.threshold,
                                       .neighbourhood = options_.neighbourhood,
                                       .previous = options_.previous,
                                       .iterations = options_.iterations};
  const color::Criterion criterion(background, criterion_options);
  auto ground = std::make_shared<color::Ground>();
  ground->segmenter = options_.device == Device::kOpencl
                          ? color::make_opencl_segmenter(background, criterion, field)
                          : color::make_cpu_segmenter(criterion, field);
  ground->background = std::make_shared<color::Background>(std::move(background));
  return ground;
}

void ColorModality::use(std::vector<color::Background> backgrounds) {
  if (options_.device == Device::kOpencl && !counter_) {
    counter_ = std::make_unique<const color::OpenclCounter>();
  }
  std::vector<View> views(backgrounds.size());
  parallel_for(views.size(), [&](std::size_t c) {
    View& view = views[c];
    view.blind = occluded(*small_, small_->cameras[c]);
    if (shapes().any() || options_.most_shadow_m > 0) {
      view.scale =
          std::make_shared<const BodyScale>(small_->cameras[c], scene().area, scene().body);
    }
    if (!backgrounds[c].empty()) view.ground = make_ground(std::move(backgrounds[c]));
  });
  views_ = std::move(views);
}

}  // namespace plaza
