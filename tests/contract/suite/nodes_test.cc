// Nodes that break one promise at a time.
#include <algorithm>
#include <atomic>
#include <fstream>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// Ten frames of images.
class Clip final : public Source {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("clip", "Ten grey frames");
    d.output<FrameSet>("images").parameters(fault_parameter());
    return d;
  }
  Clip(const Options& options, const BuildContext& context)
      : fault_(options.fault), scene_(context.scene) {
    if (fault_ == "throws") throw UserError("no film in the camera");
  }

 protected:
  Diagnostics do_check() const override {
    if (fault_ == "check")
      return {{.where = {}, .pointer = "/fault", .message = "film is missing"}};
    return {};
  }
  SourceInfo do_open() override { return {10, true}; }
  void do_seek(std::int64_t frame) override {
    if (frame > 10 && fault_ != "seek-beyond") throw UserError("the clip has 10 frames");
    if (frame > 0 && fault_ == "seek-shift") shift_ = 1;
  }
  bool do_read(NodeIo& io) override {
    if (io.frame() >= 10 && fault_ != "resumes") {
      if (fault_ == "late") io.out(0, std::make_shared<FrameSet>());
      return false;
    }
    if (io.frame() == 10) return ended_ ? (emit(io), true) : !(ended_ = true);
    if (io.frame() > 10) return false;
    if (fault_ == "empty") return false;
    emit(io);
    return true;
  }

 private:
  void emit(NodeIo& io) {
    auto frames = std::make_shared<FrameSet>();
    frames->frame = io.frame() + (fault_ == "frame" ? 1 : 0);
    frames->time_ns = fault_ == "time" ? 0 : io.time_ns();
    const int type = fault_ == "grey" ? CV_8UC1 : CV_8UC3;
    const int wider = fault_ == "size" ? 2 : 0;
    double grey = 50.0 + static_cast<double>(io.frame() + shift_);
    if (fault_ == "random") grey += ++calls_ % 100;
    for (const Camera& camera : scene_->cameras) {
      frames->views.emplace_back(camera.height(), camera.width() + wider, type,
                                 cv::Scalar::all(grey));
    }
    if (fault_ == "views") frames->views.pop_back();
    if (fault_ == "type") {
      io.out(0, std::make_shared<Observations>());
    } else {
      io.out(0, std::move(frames));
    }
  }
  std::string fault_;
  std::shared_ptr<const Scene> scene_;
  std::int64_t shift_ = 0;
  bool ended_ = false;
  int calls_ = 0;
};

TEST(SourceContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Clip>({
      {"throws", "making the component threw: no film in the camera"},
      {"check", "check() finds fault with a trial that should work: /fault: film is missing"},
      {"empty", "gives no frame at all"},
      {"seek-beyond", "seek() far beyond the end must throw UserError"},
      {"seek-shift", "reading from a frame after seek() gives other payloads"},
      {"late", "emits a payload though read() says that the end was reached"},
      {"resumes", "gives a frame after it said that the end was reached"},
      {"frame", "FrameSet::frame is not the frame that was asked for"},
      {"time", "FrameSet::time_ns is not the scene's time"},
      {"grey", "images must be 8-bit BGR"},
      {"size", "an image has another size than its camera"},
      {"views", "a FrameSet needs one view per camera"},
      {"random", "reading a second time gives other payloads"},
      {"type", "output 0 is declared as Frames but is Observations"},
  });
}

TEST(SourceContractTest, AFollowerGivesNoFramesAndDoesNotEnd) {
  Trial trial;
  trial.role = SourceRole::kFollower;
  EXPECT_THAT(
      violations(subject_of<Clip>(), trial),
      testing::IsSupersetOf({"a follower must not end", "a follower must not give Frames"}));
}

/// Mean brightness of the box under each pose.
class Brightness final : public Modality {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("brightness", "Bright boxes");
    d.input<FrameSet>("images").output<EvidenceSet>("grey values");
    d.output<ForegroundMask>("everything").memory().parameters(fault_parameter());
    return d;
  }
  Brightness(const Options& options, const BuildContext& context)
      : Modality(context), fault_(options.fault) {}

 private:
  struct Grey : Evidence {
    cv::Mat image;
    std::string fault;
    std::vector<Picture> pictures() const override {
      Picture grey{"grey", "grey values", image};
      if (fault == "picture-name") grey.name = "Grey/values";
      if (fault == "picture-caption") grey.caption.clear();
      if (fault == "picture-size") grey.image = image.rowRange(1, image.rows);
      if (fault == "picture-twice") return {grey, grey};
      return {grey};
    }
  };
  struct Boxes : TemplateBatch {
    std::vector<cv::Rect> boxes;
    std::size_t size() const override { return boxes.size(); }
  };
  Prepared do_prepare(const cv::Mat& image, std::size_t,
                      const cv::Mat& /*previous*/) const override {
    auto grey = std::make_shared<Grey>();
    grey->fault = fault_;
    image.copyTo(grey->image);
    if (fault_ == "random") grey->image.rowRange(40, 90).setTo(cv::Scalar::all(++calls_));
    if (fault_ == "scribbles") const_cast<cv::Mat&>(image).setTo(0);
    cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(255));
    if (fault_ == "remembers") mask.setTo(255 * (++calls_ % 2));
    if (fault_ == "mask") mask = cv::Mat(image.size(), CV_8UC1, cv::Scalar(7));
    return {grey, mask};
  }
  std::unique_ptr<TemplateBatch> do_sample(const ShapeModel& model, std::span<const Pose> poses,
                                           std::size_t camera) const override {
    auto batch = std::make_unique<Boxes>();
    for (const Pose& pose : poses) {
      const Box box = model.silhouette(pose, scene().cameras[camera]).box;
      const cv::Rect image(0, 0, scene().cameras[camera].width(), scene().cameras[camera].height());
      batch->boxes.push_back(cv::Rect(static_cast<int>(box.left), static_cast<int>(box.top),
                                      static_cast<int>(box.width), static_cast<int>(box.height)) &
                             image);
    }
    if (fault_ == "count") batch->boxes.emplace_back();
    return batch;
  }
  void do_match(const Evidence& evidence, const TemplateBatch& templates,
                std::span<const std::uint32_t> which, std::span<double> out) const override {
    const auto& grey = static_cast<const Grey&>(evidence).image;
    const auto& boxes = static_cast<const Boxes&>(templates).boxes;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const cv::Rect& box = boxes[fault_ == "subset" ? i : which[i]];
      double sum = 0;
      for (int y = box.y; y < box.br().y; ++y) {
        for (int x = box.x; x < box.br().x; ++x) sum += grey.at<cv::Vec3b>(y, x)[0];
      }
      // outside all views: cannot tell
      out[i] = box.empty() ? std::numeric_limits<double>::quiet_NaN() : sum;
      if (fault_ == "infinite") out[i] = -std::numeric_limits<double>::infinity();
      if (fault_ == "jitter") out[i] = static_cast<double>(++calls_);
    }
  }
  EvidencePtr do_explain(const EvidencePtr& evidence, const TemplateBatch& templates,
                         std::size_t index) const override {
    const auto& grey = static_cast<const Grey&>(*evidence);
    auto rest = std::make_shared<Grey>();
    rest->image = fault_ == "explain-in-place" ? grey.image : grey.image.clone();
    const cv::Rect box = static_cast<const Boxes&>(templates).boxes[index];
    rest->image(box).setTo(cv::Scalar::all(fault_ == "explain-more" ? 255 : 0));
    return rest;
  }

  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(ModalityContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Brightness>({
      {"random", "prepare() gives another answer in several threads at once"},
      {"mask", "the foreground has values other than 0 and 255"},
      {"count", "sample() must return one template per pose"},
      {"infinite", "match() gives an infinite likelihood"},
      {"jitter", "match() gives another answer the second time"},
      {"subset", "match() of some templates gives other values than match() of all"},
      {"explain-in-place", "explain() changes the evidence that it was given"},
      {"explain-more", "a template is more likely after its evidence was explained"},
      {"remembers",
       "the node's foreground is not that of prepare() with the mask of the frame before"},
      {"scribbles", "prepare() writes to the image"},
      {"picture-name", "picture 'Grey/values' has a name that makes no file name"},
      {"picture-caption", "picture 'grey' has no caption"},
      {"picture-size", "picture 'grey' is not 8-bit BGR of the view's size"},
      {"picture-twice", "picture 'grey' is there twice"},
  });
}

/// One person per detection.
class FromBoxes final : public Detector {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("from-boxes", "Feet of boxes");
    d.input<Detections>("boxes").optional_input<FrameSet>("images").output<Observations>("people");
    d.output<GroundLikelihood>("two cells").parameters(fault_parameter());
    return d;
  }
  FromBoxes(const Options& options, const BuildContext& context)
      : fault_(options.fault), scene_(context.scene) {}

 protected:
  Observations do_detect(const NodeIo& io) const override {
    Observations out;
    if (fault_ == "needs-images") (void)io.in<FrameSet>(1);
    const Detections& detections = io.in<Detections>(0);
    for (std::size_t c = 0; c < detections.views.size(); ++c) {
      for (const ImageDetection& d : detections.views[c]) {
        const auto foot =
            scene_->cameras[c].to_plane({d.box.left + d.box.width / 2, d.box.bottom()});
        if (!foot) continue;
        Observation o;
        o.position_m = *foot;
        o.probability = fault_ == "probability" ? 1.5 : 0.5;
        if (fault_ == "covariance") o.covariance_m2(0, 1) = 3;
        if (fault_ == "memory") o.position_m.x() += 1e-3 * static_cast<double>(++calls_);
        o.boxes.push_back({fault_ == "camera" ? 17 : c, d.box, d.score});
        out.items.push_back(o);
      }
    }
    if (fault_ == "ghost") out.items.emplace_back();
    if (fault_ == "writes") const_cast<Detections&>(detections).views.at(0).clear();
    return out;
  }
  Detected do_detect_all(const NodeIo& io) const override {
    auto likelihood = std::make_shared<GroundLikelihood>();
    likelihood->grid.columns = 2;
    likelihood->grid.rows = 1;
    likelihood->joint = {-1, std::numeric_limits<double>::quiet_NaN()};
    if (fault_ == "cells") likelihood->joint.pop_back();
    if (fault_ == "certain") likelihood->joint[0] = -std::numeric_limits<double>::infinity();
    if (fault_ == "surface") likelihood.reset();
    return {do_detect(io), likelihood};
  }

 private:
  std::string fault_;
  std::shared_ptr<const Scene> scene_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(DetectorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<FromBoxes>({
      {"needs-images", "detect() without the optional inputs threw"},
      {"probability", "probability is not in [0, 1]"},
      {"covariance", "covariance is not symmetric positive definite"},
      {"memory", "a frame's result depends on the frames seen before it"},
      {"camera", "a box names a camera that the scene lacks"},
      {"ghost", "people are found where no view shows anything"},
      {"writes", "process() changes its input"},
      {"cells", "a ground likelihood needs one value per cell of its grid"},
      {"certain", "a ground likelihood is infinite"},
      {"surface", "the declared GroundLikelihood was not computed"},
  });
}

class Turn final : public Describer {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("turn", "Everybody looks along x");
    d.input<Observations>("people").output<Observations>("the same, with headings");
    d.parameters(fault_parameter());
    return d;
  }
  Turn(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_describe(const NodeIo&, Observations& observations) override {
    for (Observation& o : observations.items) {
      o.heading_rad = 0;
      if (fault_ == "moves") o.position_m.x() += 1;
      if (fault_ == "doubts") o.probability *= 0.5;
    }
    if (fault_ == "drops" && !observations.items.empty()) observations.items.pop_back();
    if (fault_ == "random" && !observations.items.empty())
      observations.items[0].heading_rad = ++calls_;
    if (fault_ == "assumes") observations.items.at(0).heading_rad = 1;
  }

 private:
  std::string fault_;
  static inline int calls_ = 0;
};

TEST(DescriberContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Turn>({
      {"moves", "a describer must not move or reorder observations"},
      {"doubts", "changes more of an observation than its heading and features"},
      {"drops", "a describer must not add or drop observations"},
      {"random", "the same input gives another output"},
      {"assumes", "frames in which nobody is seen threw"},
  });
}

/// Gives every observation the id of its place in the list; open for one frame, then final.
class ByIndex final : public Associator {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("by-index", "The n-th observation is person n");
    d.input<Observations>("people").output<Tracks>("tracks").parameters(fault_parameter());
    return d;
  }
  ByIndex(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  AssociatorOutput do_push(const AssociatorInput& input) override {
    AssociatorOutput out = finals();
    for (std::size_t i = 0; i < input.observations->items.size(); ++i) {
      TrackPoint p;
      p.id = static_cast<TrackId>(i) + (fault_ == "zero-id" ? 0 : 1);
      p.frame = input.frame;
      p.position_m = input.observations->items[i].position_m;
      p.score = fault_ == "score" ? 2 : 1;
      if (fault_ == "random") p.score = 1.0 / ++calls_;
      if (fault_ == "future") p.frame += 1;
      if (fault_ == "final-twice") p.final = true;
      if (fault_ == "other-frame")
        p.frame = input.frame / 2 * 2 == input.frame ? input.frame : input.frame - 1;
      out.points.push_back(p);
      open_.push_back(p);
    }
    if (fault_ == "two-at-once" && !out.points.empty()) out.points.push_back(out.points.back());
    if (fault_ == "ghost") {
      TrackPoint p;
      p.id = 1000;
      p.frame = input.frame;
      out.points.push_back(p);
    }
    if (fault_ == "needs-people") (void)input.observations->items.at(0);
    if (fault_ == "silent") out.points.clear();
    return out;
  }
  AssociatorOutput do_flush_tracks() override {
    AssociatorOutput out = fault_ == "silent" ? AssociatorOutput() : finals();
    if (fault_ == "stays-open") {
      for (TrackPoint& p : out.points) p.final = false;
    }
    return out;
  }

 private:
  AssociatorOutput finals() {
    AssociatorOutput out;
    out.points = std::move(open_);
    open_.clear();
    for (TrackPoint& p : out.points) p.final = true;
    return out;
  }
  std::string fault_;
  std::vector<TrackPoint> open_;
  static inline int calls_ = 0;
};

TEST(AssociatorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<ByIndex>({
      {"zero-id", "id is not positive"},
      {"score", "score not in [0, 1]"},
      {"random", "the same input gives another output"},
      {"future", "speaks of a frame that was not pushed"},
      {"other-frame", "speaks of a point again after it was final"},
      {"final-twice", "speaks of a point again after it was final"},
      {"two-at-once", "gives two points of one id and frame at once"},
      {"ghost", "tracks come out of frames in which nobody is seen"},
      {"needs-people", "a stream of empty frames threw"},
      {"silent", "give no track"},
      {"stays-open", "still open after flush"},
  });
}

/// The share of true people within 0.3 m of a track.
class Found final : public Evaluator {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("found", "How many were found");
    d.input<Tracks>("tracks").input<GroundTruth>("truth");
    d.metric({"found", "share", "", Better::kHigher, "people that were found"});
    d.parameters(fault_parameter());
    return d;
  }
  Found(const Options& options, const BuildContext&) : fault_(options.fault) {}

 protected:
  void do_observe(const NodeIo& io) override {
    const auto* tracks = io.find<Tracks>(0);
    const auto* truth = io.find<GroundTruth>(1);
    if (fault_ == "needs-flush") (void)io.in<Tracks>(0);
    if (tracks == nullptr || truth == nullptr) return;
    for (const TruePerson& person : truth->people) {
      ++people_;
      for (const TrackPoint& p : tracks->points) {
        if ((p.position_m - *person.position_m).norm() < 0.3) {
          ++found_;
          break;
        }
      }
    }
  }
  Evaluation do_evaluate() override {
    Evaluation out;
    const double share = people_ > 0 || fault_ == "nan" ? found_ / people_ : 0;
    if (fault_ == "nothing" || people_ == 0) {
      if (fault_ == "nan") out["found"]["share"] = share;
      return out;
    }
    out["found"]["share"] = fault_ == "backwards" ? 1 - share : share;
    if (fault_ == "undeclared") out["found"]["luck"] = 0.5;
    if (fault_ == "other-section") out["lost"]["share"] = 0.5;
    if (fault_ == "random") out["found"]["share"] = share / ++calls_;
    return out;
  }

 private:
  std::string fault_;
  double people_ = 0, found_ = 0;
  static inline int calls_ = 0;
};

TEST(EvaluatorContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Found>({
      {"needs-flush", "the evaluation of a perfect result threw"},
      {"backwards", "is worse for a perfect result"},
      {"undeclared", "\"found.luck\", which is neither a declared metric nor a parameter"},
      {"other-section", "gives section \"lost\", of which it declares no metric"},
      {"random", "the same input gives other figures"},
      {"nothing", "gives none of its declared metrics"},
      {"nan", "not finite"},
  });
}

class Rows final : public Sink {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("rows", "Counts observations");
    d.input<Observations>("people").optional_input<Tracks>("tracks").parameters(fault_parameter());
    return d;
  }
  Rows(const Options& options, const BuildContext& context)
      : fault_(options.fault), file_(context.output_folder / "rows.csv") {
    if (fault_ == "elsewhere")
      file_ = std::filesystem::temp_directory_path() / "plaza-contract-rows.csv";
  }

 protected:
  void do_write(const NodeIo& io) override {
    if (fault_ == "needs-tracks") (void)io.in<Tracks>(1);
    const auto* people = io.find<Observations>(0);
    text_ += std::to_string(people != nullptr ? people->items.size() : 0) + "\n";
    if (fault_ == "random") text_ += std::to_string(++calls_) + "\n";
  }
  std::vector<Artifact> do_finish(bool complete) override {
    if (fault_ == "partial" && !complete) throw InternalError("not done yet");
    if (fault_ == "half-line" && !complete) text_ += "12,";
    if (fault_ != "missing") std::ofstream(file_) << text_;
    return {{file_, fault_ == "mute" ? "" : "numbers of people"}};
  }

 private:
  std::string fault_;
  std::filesystem::path file_;
  std::string text_;
  static inline int calls_ = 0;
};

TEST(SinkContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Rows>({
      {"elsewhere", "an artifact lies outside the output folder"},
      {"needs-tracks", "threw: input 1 (Tracks) is not connected"},
      {"random", "the same input gives other files"},
      {"partial", "writing 20 frames threw: not done yet"},
      {"half-line", "rows.csv ends in the middle of a line"},
      {"missing", "the artifact rows.csv does not exist"},
      {"mute", "an artifact does not say what it is"},
  });
}

class Pages final : public Renderer {
 public:
  using Options = Fault;
  static Declaration<Options> declare() {
    Declaration<Options> d("pages", "A list of frames");
    d.input<FrameSet>("images").input<Tracks>("tracks").optional_input<GroundTruth>("truth");
    d.parameters(fault_parameter());
    return d;
  }
  Pages(const Options& options, const BuildContext& context)
      : fault_(options.fault), file_(context.output_folder / "pages.json") {}

 protected:
  void do_begin(std::int64_t, std::int64_t) override { pages_ = nlohmann::json::array(); }
  void do_render(const RenderFrame& frame) override {
    if (fault_ == "needs-truth" && frame.ground_truth == nullptr) throw InternalError("no truth");
    if (fault_ == "needs-images" && frame.frames->views.at(0).empty())
      throw InternalError("no image");
    pages_.push_back(frame.frame);
  }
  std::vector<Artifact> do_end(bool complete) override {
    std::string text = pages_.dump() + "\n";
    if (fault_ == "broken" && !complete) text = "[1,\n";
    std::ofstream(file_) << text;
    return {{file_, "frames"}};
  }

 private:
  std::string fault_;
  std::filesystem::path file_;
  nlohmann::json pages_;
};

TEST(RendererContractTest, EachBrokenPromiseIsCaught) {
  expect_caught<Pages>({
      {"needs-truth", "threw: no truth"},
      {"needs-images", "threw: no image"},
      {"broken", "pages.json is not valid JSON"},
  });
}

}  // namespace
}  // namespace plaza::contract
