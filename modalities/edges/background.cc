#include "modalities/edges/background.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "modalities/edges/background_file.h"
#include "plaza/core/error.h"
#include "plaza/core/parallel.h"

namespace plaza::edges {
namespace {

/// Per pixel the lower median of 8-bit images of one size.
cv::Mat1b median_of(const std::vector<cv::Mat1b>& images) {
  cv::Mat1b out(images.front().size());
  std::vector<unsigned char> values(images.size());
  const std::size_t middle = (images.size() - 1) / 2;
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      for (std::size_t i = 0; i < images.size(); ++i) values[i] = images[i](y, x);
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle),
                       values.end());
      out(y, x) = values[middle];
    }
  }
  return out;
}

/// (G_bx, G_by) with G_bx^2 + G_by^2 = 1 wherever the gradient is not zero.
cv::Mat2f unit_gradient(const cv::Mat1f& dx, const cv::Mat1f& dy) {
  cv::Mat2f out(dx.size(), cv::Vec2f(0, 0));
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      const float length = std::sqrt(dx(y, x) * dx(y, x) + dy(y, x) * dy(y, x));
      if (length > 0) out(y, x) = {dx(y, x) / length, dy(y, x) / length};
    }
  }
  return out;
}

}  // namespace

ViewBackground make_background(const cv::Mat1b& edges, const cv::Mat2f& gradient,
                               double tolerance_px) {
  ViewBackground background;
  background.known = true;
  background.edges = edges;
  background.gradient = gradient;
  cv::Mat1f distance;
  cv::Mat1b elsewhere;
  cv::compare(edges, 0, elsewhere, cv::CMP_EQ);
  cv::distanceTransform(elsewhere, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::compare(distance, tolerance_px + 1e-4, background.zone, cv::CMP_LE);
  return background;
}

BackgroundLearner::BackgroundLearner(const BackgroundOptions& options,
                                     std::shared_ptr<const Scene> scene, Shrink shrink)
    : options_(options),
      scene_(std::move(scene)),
      shrink_(shrink),
      pupils_(scene_->cameras.size()),
      views_(scene_->cameras.size()) {}

std::optional<LearningPlan> BackgroundLearner::do_plan() const {
  return LearningPlan{.people_free_only = options_.method == BackgroundMethod::kPeopleFree,
                      .first = options_.first,
                      .every = options_.every};
}

void BackgroundLearner::do_learn(const FrameSet& frames) {
  if (frames.views.size() != pupils_.size()) {
    throw InternalError("images of " + std::to_string(frames.views.size()) +
                        " views in a scene of " + std::to_string(pupils_.size()));
  }
  parallel_for(pupils_.size(), [&](std::size_t c) {
    const cv::Mat& image = frames.views[c];
    if (image.empty()) return;
    const Camera& camera = scene_->cameras[c];
    if (image.cols != camera.width() || image.rows != camera.height() || image.type() != CV_8UC3) {
      UserError error("image is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) +
                      ", the calibration of camera '" + camera.name() + "' is for " +
                      std::to_string(camera.width()) + "x" + std::to_string(camera.height()) +
                      " BGR");
      error.add_context({.component = {}, .frame = {}, .camera = camera.name()});
      throw error;
    }
    learn_view(shrink_(image), pupils_[c]);
  });
}

void BackgroundLearner::learn_view(const cv::Mat& image, Pupil& pupil) const {
  const std::int64_t index = pupil.frames++;
  if (options_.method == BackgroundMethod::kMedian) {
    if (index % pupil.stride != 0) return;
    if (pupil.grey.size() == kMedianFrames) {
      // the length of a stream need not be known: half as dense from here on, and so far
      for (std::size_t i = 1; 2 * i < pupil.grey.size(); ++i) pupil.grey[i] = pupil.grey[2 * i];
      pupil.grey.resize(kMedianFrames / 2);
      pupil.stride *= 2;
      if (index % pupil.stride != 0) return;
    }
    cv::Mat1b grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    pupil.grey.push_back(grey);
    return;
  }
  find_edges(image, options_.edges, pupil.image);
  if (pupil.edges.empty()) {
    pupil.edges = cv::Mat1b(image.size(), uchar{0});
    pupil.dx = cv::Mat1f(image.size(), 0.0F);
    pupil.dy = cv::Mat1f(image.size(), 0.0F);
  }
  cv::bitwise_or(pupil.edges, pupil.image.edges, pupil.edges);
  cv::add(pupil.dx, pupil.image.dx, pupil.dx, cv::noArray(), CV_32F);
  cv::add(pupil.dy, pupil.image.dy, pupil.dy, cv::noArray(), CV_32F);
}

ViewBackground BackgroundLearner::finish_view(Pupil& pupil) const {
  if (pupil.frames == 0) return {};
  if (options_.method == BackgroundMethod::kMedian) {
    EdgeOptions sensitive = options_.edges;
    sensitive.low *= options_.sensitivity;
    sensitive.high *= options_.sensitivity;
    find_edges(median_of(pupil.grey), sensitive, pupil.image);
    pupil.edges = pupil.image.edges.clone();
    pupil.image.dx.convertTo(pupil.dx, CV_32F);
    pupil.image.dy.convertTo(pupil.dy, CV_32F);
  }
  return make_background(pupil.edges, unit_gradient(pupil.dx, pupil.dy), options_.tolerance_px);
}

void BackgroundLearner::do_finish(std::int64_t seen) {
  if (seen < 1) {
    throw UserError(
        options_.method == BackgroundMethod::kPeopleFree
            ? "the background needs at least one frame without people, and the source marks none "
              "as such; name them there, or learn from frames with people: \"background\": "
              "\"median\""
            : "the background needs at least one frame");
  }
  parallel_for(pupils_.size(), [&](std::size_t c) {
    views_[c] = std::make_shared<const ViewBackground>(finish_view(pupils_[c]));
  });
  pupils_.assign(pupils_.size(), {});
}

void BackgroundLearner::do_save(std::ostream& out) const {
  save_backgrounds(out, *shrink_(scene_), views_);
}

void BackgroundLearner::do_load(std::istream& in) {
  views_ = load_backgrounds(in, *shrink_(scene_), options_.tolerance_px);
}

}  // namespace plaza::edges
