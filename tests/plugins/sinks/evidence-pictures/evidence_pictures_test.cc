#include "plugins/sinks/evidence-pictures/evidence_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "plaza/contract/gtest.h"
#include "plaza/data/evidence.h"
#include "plaza/data/ground_likelihood.h"
#include "tests/plugins/sinks/sink_scene.h"
#include "tests/support/temporary_folder.h"

namespace plaza::evidence_pictures {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

struct Striped final : Evidence {
  std::vector<Picture> pictures() const override {
    return {{"stripes", "nothing but stripes", cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3))},
            {"dots", "nothing but dots", cv::Mat(480, 640, CV_8UC3, cv::Scalar(4, 5, 6))}};
  }
};

/// A run of the sink over frames 0, 1, 2, ... with evidence of one modality.
struct SinkRun {
  std::shared_ptr<Scene> scene = test::ring_scene(2);
  EvidencePictures::Options options;
  bool second_view = true, likelihood = false;
  test::TemporaryFolder folder;
  std::vector<Artifact> artifacts;

  void run(std::int64_t frames) {
    BuildContext context = test::context_of(scene, folder.path());
    context.name = "pictures";
    context.input_lists["evidence"] = {{.slot = 2, .from = "edges", .producer = {}, .fields = {}}};
    EvidencePictures sink(options, context);
    for (std::int64_t f = 0; f < frames; ++f) {
      std::vector<PayloadPtr> slots = {frames_of(f), likelihood ? surface() : nullptr, evidence()};
      const std::vector<int> inputs = {0, 1, 2};
      NodeIo io(f, 0, slots.data(), inputs, {});
      sink.process(io);
    }
    artifacts = sink.finish(true);
  }
  PayloadPtr frames_of(std::int64_t frame) const {
    auto set = std::make_shared<FrameSet>();
    set->frame = frame;
    set->views.assign(2, cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(100)));
    if (!second_view) set->views[1] = cv::Mat();
    return set;
  }
  PayloadPtr evidence() const {
    auto set = std::make_shared<EvidenceSet>();
    set->views.assign(2, std::make_shared<Striped>());
    if (!second_view) set->views[1] = nullptr;
    return set;
  }
  static PayloadPtr surface() {
    auto surface = std::make_shared<GroundLikelihood>();
    surface->grid.origin_m = {-4, -3};
    surface->grid.columns = 8;
    surface->grid.rows = 6;
    surface->joint.assign(48, -1.0);
    surface->views.assign(2, surface->joint);
    return surface;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      if (entry.is_regular_file()) {
        names.push_back(fs::relative(entry.path(), folder.path()).string());
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

TEST(EvidencePicturesContract, IsKept) {
  contract::Trial trial;
  trial.values = {{"frames", {3, 1}}, {"evidence", {{{"from", "edges"}}, {{"from", "color"}}}}};
  contract::expect_kept(contract::subject_of<EvidencePictures>(), trial);
}

TEST(EvidencePictures, WritesTheChosenFramesOnly) {
  SinkRun run;
  run.options.frames = {2, 900};
  run.run(4);
  EXPECT_THAT(
      run.files(),
      ElementsAre("pictures/000002/cam1/edges.dots.png", "pictures/000002/cam1/edges.stripes.png",
                  "pictures/000002/cam1/image.png", "pictures/000002/cam2/edges.dots.png",
                  "pictures/000002/cam2/edges.stripes.png", "pictures/000002/cam2/image.png",
                  "pictures/sheet-000002.png"));
  ASSERT_EQ(run.artifacts.size(), 1u) << "frame 900 is not part of the run";
  EXPECT_EQ(run.artifacts[0].file, run.folder.path() / "pictures/sheet-000002.png");
  const cv::Mat dots =
      cv::imread((run.folder.path() / "pictures/000002/cam1/edges.dots.png").string());
  EXPECT_EQ(dots.at<cv::Vec3b>(7, 7), cv::Vec3b(4, 5, 6));
  EXPECT_EQ(cv::imread(run.artifacts[0].file.string()).cols, run.options.sheet_width_px);
}

TEST(EvidencePictures, AMissingViewHasNoPictures) {
  SinkRun run;
  run.second_view = false;
  run.run(1);
  for (const std::string& file : run.files()) {
    EXPECT_EQ(file.find("cam2"), std::string::npos) << file;
  }
  EXPECT_EQ(run.artifacts.size(), 1u);
}

TEST(EvidencePictures, DrawsTheLikelihoodWhereThereIsOne) {
  SinkRun run;
  run.likelihood = true;
  run.run(1);
  EXPECT_THAT(run.files(), testing::IsSupersetOf({"pictures/000001/likelihood-surface.png",
                                                  "pictures/000001/cam1/likelihood.png",
                                                  "pictures/000001/cam2/likelihood-of-view.png"}));
}

TEST(EvidencePictures, AFolderThatCannotBeMadeIsTheUsersError) {
  SinkRun run;
  fs::create_directories(run.folder.path());
  cv::imwrite((run.folder.path() / "x.png").string(), cv::Mat(1, 1, CV_8UC3));
  fs::rename(run.folder.path() / "x.png", run.folder.path() / "pictures");
  EXPECT_THROW(run.run(1), UserError);
}

}  // namespace
}  // namespace plaza::evidence_pictures
