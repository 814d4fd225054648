// Modalities that break one promise at a time.
#include <atomic>
#include <limits>
#include <string>

#include "tests/contract/suite/misbehaving.h"

namespace plaza::contract {
namespace {

/// Mean brightness of the box under each pose.
class Brightness : public Modality {
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
  struct Notes : Memory {
    mutable int read = 0;
  };
  struct Boxes : TemplateBatch {
    std::vector<cv::Rect> boxes;
    std::size_t size() const override { return boxes.size(); }
  };
  Prepared do_prepare(const cv::Mat& image, std::size_t, const Past& past) const override {
    auto grey = std::make_shared<Grey>();
    grey->fault = fault_;
    image.copyTo(grey->image);
    if (fault_ == "random") grey->image.rowRange(40, 90).setTo(cv::Scalar::all(++calls_));
    if (fault_ == "scribbles") const_cast<cv::Mat&>(image).setTo(0);
    cv::Mat mask(image.size(), CV_8UC1, cv::Scalar(255));
    if (fault_ == "remembers") mask.setTo(255 * (++calls_ % 2));
    if (fault_ == "mask") mask = cv::Mat(image.size(), CV_8UC1, cv::Scalar(7));
    if (fault_ == "hands-on") return {grey, mask, std::make_shared<Memory>()};
    if (fault_ == "rewrites") {
      const auto* notes = dynamic_cast<const Notes*>(past.memory.get());
      if (notes != nullptr) mask.setTo(255 * (++notes->read % 2));
      return {grey, mask, std::make_shared<Notes>()};
    }
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
                         std::span<const std::uint32_t> which) const override {
    const auto& grey = static_cast<const Grey&>(*evidence);
    auto rest = std::make_shared<Grey>();
    rest->image = fault_ == "explain-in-place" ? grey.image : grey.image.clone();
    for (const std::uint32_t index : fault_ == "explain-one" ? which.first(1) : which) {
      const cv::Rect box = static_cast<const Boxes&>(templates).boxes[index];
      rest->image(box).setTo(cv::Scalar::all(fault_ == "explain-more" ? 255 : 0));
    }
    return rest;
  }

  std::string fault_;
  mutable std::atomic<int> calls_ = 0;
};

/// The same without saying that it remembers.
class Forgetful final : public Brightness {
 public:
  static Declaration<Options> declare() {
    Declaration<Options> d("forgetful", "Bright boxes");
    d.input<FrameSet>("images").output<EvidenceSet>("grey values");
    d.output<ForegroundMask>("everything").parameters(fault_parameter());
    return d;
  }
  using Brightness::Brightness;
};

TEST(ModalityContractTest, OnlyWhoDeclaresMemoryHandsAnythingOn) {
  expect_caught<Forgetful>({
      {"hands-on", "prepare() hands something on, but no memory is declared"},
  });
}

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
      {"explain-one", "explain() of two templates is not explain() of one after the other"},
      {"remembers",
       "the node's foreground is not that of prepare() with what the frame before left"},
      {"rewrites", "prepare() gives another answer when it is given the same past again"},
      {"scribbles", "prepare() writes to the image"},
      {"picture-name", "picture 'Grey/values' has a name that makes no file name"},
      {"picture-caption", "picture 'grey' has no caption"},
      {"picture-size", "picture 'grey' is not 8-bit BGR of the view's size"},
      {"picture-twice", "picture 'grey' is there twice"},
  });
}

}  // namespace
}  // namespace plaza::contract
