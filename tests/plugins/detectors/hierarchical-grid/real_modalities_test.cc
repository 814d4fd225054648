// The detector on what the modalities of the build tree see in noisy pictures of cylinders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "framework/plugin/loader.h"
#include "plaza/component/learner.h"
#include "plaza/data/frames.h"
#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

constexpr double kNoise = 6;  // grey levels, standard deviation, each pixel and channel

const Registry& registry() {
  static const Registry kRegistry = [] {
    Registry r;
    for (const char* name : {"cylinder", "edges", "color"}) {
      load_plugin(fs::path(PLAZA_BINARY_DIR) / "lib" / "plaza" / "plugins" /
                      ("plaza_" + std::string(name) + ".so"),
                  r);
    }
    return r;
  }();
  return kRegistry;
}

template <class T>
std::shared_ptr<T> make(const std::string& name, const BuildContext& context) {
  const ComponentEntry* entry = registry().find(name);
  if (entry == nullptr) throw std::runtime_error(registry().explain_missing(name, {}));
  return std::dynamic_pointer_cast<T>(entry->create(nlohmann::json::object(), context));
}

class RealModalities : public ::testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  RealModalities() : scene_(testing::round_scene(std::get<1>(GetParam()))) {
    for (Camera& camera : scene_->cameras) camera = camera.scaled({320, 240});
    BuildContext context = testing::context_of(scene_);
    shape_ = make<ShapeModel>("cylinder", context);
    modality_ = make<Modality>(std::get<0>(GetParam()), context);
    for (unsigned i = 0; i < 5; ++i) {
      FrameSet empty;
      empty.views = draw({}, 100 + i);
      modality_->learner()->learn(empty);
    }
    modality_->learner()->finish(5);

    HierarchicalGrid::Options options;
    options.cells = 32;
    options.margin_m = 1;
    context.part_lists["shape"] = {{"shape", shape_}};
    context.input_lists["modalities"] = {{0, "modality", modality_, {{"weight", 1.0}}}};
    detector_ = std::make_unique<HierarchicalGrid>(options, context);
    detector_->learner()->finish(0);
  }

  /// People in dark red, so that they differ in colour and in brightness, on a ground with light
  /// and dark stones.
  std::vector<cv::Mat> draw(const std::vector<Eigen::Vector2d>& people, unsigned seed) const {
    cv::RNG random(seed);
    std::vector<cv::Mat> views;
    for (const Camera& camera : scene_->cameras) {
      cv::Mat image(camera.height(), camera.width(), CV_8UC3);
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          const bool light = (x / 40 + y / 30) % 2 == 0;
          image.at<cv::Vec3b>(y, x) = light ? cv::Vec3b(130, 140, 125) : cv::Vec3b(85, 100, 80);
        }
      }
      for (const Eigen::Vector2d& person : people) {
        for (const RowSpan& s : shape_->silhouette({person, 0, 1}, camera).spans)
          image(cv::Rect(s.begin, s.row, s.end - s.begin, 1)).setTo(cv::Scalar(25, 20, 110));
      }
      cv::Mat grain(image.size(), CV_16SC3);
      random.fill(grain, cv::RNG::NORMAL, 0, kNoise);
      cv::add(image, grain, image, cv::noArray(), CV_8U);
      views.push_back(image);
    }
    return views;
  }

  Detector::Detected detect(const std::vector<cv::Mat>& views) const {
    auto evidence = std::make_shared<EvidenceSet>();
    for (std::size_t c = 0; c < views.size(); ++c)
      evidence->views.push_back(modality_->prepare(views[c], c).evidence);
    PayloadPtr slots[3] = {evidence, nullptr, nullptr};
    const int inputs[1] = {0}, outputs[2] = {1, 2};
    return detector_->detect_all(NodeIo(0, 0, slots, inputs, outputs));
  }

  /// What is found in one frame after the other, the modality remembering what it does.
  std::vector<Observations> follow(const std::vector<std::vector<cv::Mat>>& frames) {
    std::vector<Observations> found;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      auto images = std::make_shared<FrameSet>();
      images->frame = static_cast<std::int64_t>(f);
      images->time_ns = images->frame * 40'000'000;
      images->views = frames[f];
      PayloadPtr slots[] = {images, nullptr, nullptr, nullptr, nullptr};
      const int frame_slot[] = {0}, evidence_slots[] = {1, 2}, found_slots[] = {3, 4};
      NodeIo prepared(images->frame, images->time_ns, slots, frame_slot, evidence_slots);
      modality_->process(prepared);
      const NodeIo io(images->frame, images->time_ns, slots, {evidence_slots, 1}, found_slots);
      found.push_back(detector_->detect_all(io).observations);
    }
    return found;
  }

  const StateGrid& grid() const { return detector_->grid(); }
  std::size_t views() const { return scene_->cameras.size(); }

 private:
  std::shared_ptr<Scene> scene_;
  std::shared_ptr<ShapeModel> shape_;
  std::shared_ptr<Modality> modality_;
  std::unique_ptr<HierarchicalGrid> detector_;
};

TEST_P(RealModalities, PeakAtTheTrueCell) {
  std::mt19937 random(static_cast<unsigned>(std::get<1>(GetParam())));
  std::uniform_int_distribution<CellIndex> place(8, 23);
  const std::size_t finest = grid().levels() - 1;
  for (unsigned trial = 0; trial < 4; ++trial) {
    const CellIndex row = place(random), column = place(random);
    const CellIndex truth = row * 32 + column;
    const auto detected = detect(draw({grid().position(finest, truth)}, trial));
    const std::vector<double>& joint = detected.likelihood->joint;
    const auto best = std::max_element(joint.begin(), joint.end(), [](double a, double b) {
      return std::isnan(a) ? !std::isnan(b) : a < b;
    });
    const auto found = static_cast<CellIndex>(best - joint.begin());
    EXPECT_EQ(found, truth) << "row " << found / 32 << ", column " << found % 32 << " instead of "
                            << row << ", " << column;
    ASSERT_FALSE(detected.observations.items.empty());
    const Observation& first = detected.observations.items.front();
    EXPECT_LT((first.position_m - grid().position(finest, truth)).norm(), 0.2);
  }
}

TEST_P(RealModalities, AfterACameraIsLostTheOthersGiveWhatTheyWouldHaveGivenWithoutIt) {
  constexpr std::size_t kLoss = 3;
  const auto people_at = [](unsigned frame) {
    const double walked = 0.05 * frame;
    return std::vector<Eigen::Vector2d>{{-1.5 + walked, 0.5}, {1.2, -1 - walked}};
  };
  std::vector<std::vector<cv::Mat>> lost, never;
  for (unsigned f = 0; f < 6; ++f) {
    lost.push_back(draw(people_at(f), f));
    never.push_back(lost.back());
    never.back().front().release();
    if (f >= kLoss) lost.back() = never.back();
  }
  const std::vector<Observations> before_and_after = follow(lost), without = follow(never);
  for (std::size_t f = kLoss; f < lost.size(); ++f) {
    const auto& found = before_and_after[f].items;
    ASSERT_EQ(found.size(), without[f].items.size()) << "frame " << f;
    for (const Eigen::Vector2d& person : people_at(static_cast<unsigned>(f))) {
      const auto is_there = [&](const Observation& o) {
        return (o.position_m - person).norm() < 0.2;
      };
      if (views() > 3) {
        EXPECT_TRUE(std::ranges::any_of(found, is_there)) << "frame " << f;
      }
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].position_m, without[f].items[i].position_m);
      EXPECT_EQ(found[i].score, without[f].items[i].score);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Views, RealModalities,
                         ::testing::Combine(::testing::Values("edges", "color"),
                                            ::testing::Range(1, 8)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + std::string("_in_") +
                                  std::to_string(std::get<1>(info.param)) + "_views";
                         });

}  // namespace
}  // namespace plaza
