#pragma once

#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "plugins/sinks/overlay-video/overlay_video.h"
#include "tests/plugins/sinks/sink_scene.h"

namespace plaza::overlay {

/// A short run of the renderer in a folder of its own.
struct OverlayRun {
  std::shared_ptr<Scene> scene = test::ring_scene(2);
  OverlayVideo::Options options;
  std::int64_t begin = 0, end = 5;
  std::int64_t stop = -1;  ///< renders only frames before it, then ends incomplete
  std::function<cv::Mat(std::size_t camera, std::int64_t frame)> image = [this](std::size_t camera,
                                                                                std::int64_t) {
    const Camera& c = scene->cameras[camera];
    return cv::Mat(c.height(), c.width(), CV_8UC3, cv::Scalar(90, 90, 90));
  };
  std::function<std::vector<TrackPoint>(std::int64_t frame)> tracks = [](std::int64_t) {
    return std::vector<TrackPoint>{};
  };
  std::function<GroundTruth(std::int64_t frame)> truth;

  test::TemporaryFolder folder;
  std::vector<Artifact> artifacts;

  void run() {
    OverlayVideo overlay(options, test::context_of(scene, folder.path()));
    Renderer& renderer = overlay;
    renderer.begin(begin, end);
    const bool complete = stop < 0;
    for (std::int64_t f = begin; f < (complete ? end : stop); ++f) {
      FrameSet frames;
      frames.frame = f;
      for (std::size_t c = 0; c < scene->cameras.size(); ++c) frames.views.push_back(image(c, f));
      const std::vector<TrackPoint> points = tracks(f);
      const GroundTruth true_people = truth ? truth(f) : GroundTruth();
      RenderFrame frame;
      frame.frame = f;
      frame.time_ns = scene->time_of_frame(f);
      frame.frames = &frames;
      frame.tracks = points;
      if (truth) frame.ground_truth = &true_people;
      renderer.render(frame);
    }
    artifacts = renderer.end(complete);
  }

  std::vector<cv::Mat> video() const {
    std::vector<cv::Mat> frames;
    cv::VideoCapture capture((folder.path() / options.file).string());
    cv::Mat frame;
    while (capture.read(frame)) frames.push_back(frame.clone());
    return frames;
  }
  /// The still of a frame from 0, losslessly what was drawn.
  cv::Mat still(std::int64_t frame) const {
    char name[48];
    std::snprintf(name, sizeof name, "overlay-%06lld.png", static_cast<long long>(frame + 1));
    return cv::imread((folder.path() / name).string());
  }
  Layout layout() const {
    std::vector<cv::Size> sizes;
    for (const Camera& c : scene->cameras) sizes.emplace_back(c.width(), c.height());
    const GroundArea extent = drawing::plan_extent(*scene);
    const Eigen::Vector2d size_m = extent.max_m - extent.min_m;
    return make_layout(sizes, size_m.x() / size_m.y(), options.width_px);
  }
};

}  // namespace plaza::overlay
