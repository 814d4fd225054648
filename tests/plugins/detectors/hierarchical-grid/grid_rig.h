#pragma once

#include <memory>
#include <random>
#include <vector>

#include "models/cylinder/cylinder.h"
#include "plaza/data/frames.h"
#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"
#include "tests/plugins/detectors/simulated_scene.h"
#include "tests/support/overlap_modality.h"

namespace plaza::test {

/// `cameras` views of 8 m x 8 m at a third of the usual size.
inline std::shared_ptr<Scene> small_scene(int cameras) {
  auto scene = testing::round_scene(cameras);
  for (Camera& camera : scene->cameras) camera = camera.scaled({213, 160});
  return scene;
}

/// A detector over a test modality, with the evidence of images that are drawn for it.
class Rig {
 public:
  explicit Rig(std::shared_ptr<Scene> scene, HierarchicalGrid::Options options = defaults())
      : scene_(std::move(scene)),
        shape_(std::make_shared<Cylinder>(Cylinder::Options(), BuildContext())) {
    BuildContext modality_context = testing::context_of(scene_);
    modality_ =
        std::make_shared<test::OverlapModality>(test::OverlapModality::Options(), modality_context);
    detector_ = make(options);
    detector_->learner()->finish(0);
  }
  static HierarchicalGrid::Options defaults() {
    HierarchicalGrid::Options o;
    o.cells = 32;
    o.margin_m = 1;
    o.min_score = 2;  // ghosts, where the silhouettes of a few views cross, have less
    return o;
  }
  std::unique_ptr<HierarchicalGrid> make(const HierarchicalGrid::Options& options) const {
    BuildContext context = testing::context_of(scene_);
    context.part_lists["shape"] = {{"shape", shape_}};
    context.input_lists["modalities"] = {{0, "overlap", modality_, {{"weight", 1.0}}}};
    return std::make_unique<HierarchicalGrid>(options, context);
  }

  /// People of one size as white cylinders on dark ground, each pixel wrong with probability
  /// `noise`.
  std::vector<cv::Mat> draw(const std::vector<Eigen::Vector2d>& people, double noise, unsigned seed,
                            double scale = 1) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<cv::Mat> views;
    for (const Camera& camera : scene_->cameras) {
      cv::Mat image(camera.height(), camera.width(), CV_8UC3, cv::Scalar::all(20));
      for (const Eigen::Vector2d& person : people) {
        for (const RowSpan& s : shape_->silhouette({person, 0, scale}, camera).spans)
          image(cv::Rect(s.begin, s.row, s.end - s.begin, 1)).setTo(cv::Scalar::all(230));
      }
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          if (uniform(random) < noise)
            image.at<cv::Vec3b>(y, x) = cv::Vec3b::all(255) - image.at<cv::Vec3b>(y, x);
        }
      }
      views.push_back(image);
    }
    return views;
  }

  struct Outcome {
    SearchResult search;
    Detector::Detected detected;
  };
  Outcome run(const HierarchicalGrid& detector, const std::vector<cv::Mat>& views) const {
    auto evidence = std::make_shared<EvidenceSet>();
    for (std::size_t c = 0; c < views.size(); ++c) {
      evidence->views.push_back(views[c].empty() ? nullptr
                                                 : modality_->prepare(views[c], c).evidence);
    }
    PayloadPtr slots[3] = {evidence, nullptr, nullptr};
    const int inputs[1] = {0}, outputs[2] = {1, 2};
    const NodeIo io(0, 0, slots, inputs, outputs);
    return {detector.search(io), detector.detect_all(io)};
  }
  Outcome run(const std::vector<cv::Mat>& views) const { return run(*detector_, views); }

  const HierarchicalGrid& detector() const { return *detector_; }
  HierarchicalGrid& detector() { return *detector_; }
  const Scene& scene() const { return *scene_; }

 private:
  std::shared_ptr<Scene> scene_;
  std::shared_ptr<Cylinder> shape_;
  std::shared_ptr<test::OverlapModality> modality_;
  std::unique_ptr<HierarchicalGrid> detector_;
};

}  // namespace plaza::test
