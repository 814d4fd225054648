#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <thread>

#include "digest.h"
#include "stage.h"

namespace plaza::contract {
namespace {

/// An upright box of pixels, enough to be sampled; it stands in for any shape.
class BoxShape final : public ShapeModel {
 protected:
  Silhouette do_silhouette(const Pose& pose, const Camera& camera) const override {
    Body scaled = do_body();
    scaled.height_m *= pose.scale;
    scaled.radius_m *= pose.scale;
    Silhouette s;
    const std::optional<Box> box = body_box(camera, pose.position_m, scaled);
    if (!box) return s;
    s.box = *box;
    const auto clamped = [](double v, int size) {
      return static_cast<std::int32_t>(std::clamp(std::round(v), 0.0, static_cast<double>(size)));
    };
    const std::int32_t left = clamped(box->left, camera.width()),
                       right = clamped(box->right(), camera.width());
    const std::int32_t top = clamped(box->top, camera.height());
    const std::int32_t bottom = clamped(box->bottom(), camera.height());
    if (left >= right || top >= bottom) return s;
    for (std::int32_t row = top; row < bottom; ++row) s.spans.push_back({row, left, right});
    s.inside_share = std::min(1.0, (right - left) * (bottom - top) / std::max(1.0, box->area()));
    for (double y = box->top; y <= box->bottom(); y += 2) {
      s.contour.push_back({{static_cast<float>(box->left), static_cast<float>(y)}, {-1, 0}});
      s.contour.push_back({{static_cast<float>(box->right()), static_cast<float>(y)}, {1, 0}});
    }
    return s;
  }
  Body do_body() const override { return {}; }
};

bool same(const std::vector<double>& a,
          const std::vector<double>& b) {  // NaN is equal to itself here
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class ModalityCheck {
 public:
  ModalityCheck(const Stage& stage, Findings& findings)
      : stage_(stage), findings_(findings), modality_(stage.make_as<Modality>()) {}

  void run() {
    for (const double x : {-4.0, -1.0, 2.0}) {
      for (const double y : {-3.5, 0.0, 3.0}) poses_.push_back({{x, y}, 0.3, 1});
    }
    for (const TruePerson& person : stage_.world().ground_truth(0).people) {
      poses_.push_back({*person.position_m, person.heading_rad.value_or(0), 1});
    }
    poses_.push_back({{500, 500}, 0, 1});  // out of every view
    for (std::size_t c = 0; c < stage_.scene().cameras.size(); ++c) one_camera(c);
    as_a_node();
    with_memory();
  }

 private:
  std::vector<double> matched(const Modality& modality, const Evidence& evidence,
                              std::size_t camera) const {
    const auto batch = modality.sample(shape_, poses_, camera);
    std::vector<double> out(poses_.size());
    modality.match(evidence, *batch, out);
    return out;
  }

  void one_camera(std::size_t camera) {
    const cv::Mat& image = stage_.world().frames(0).views[camera];
    const cv::Mat untouched = image.clone();
    const Modality::Prepared prepared = modality_->prepare(image, camera);
    findings_.require(std::equal(image.datastart, image.dataend, untouched.datastart),
                      "prepare() writes to the image");
    if (!prepared.foreground.empty()) {
      const cv::Mat& mask = prepared.foreground;
      findings_.require(mask.type() == CV_8UC1 && mask.size() == image.size(),
                        "the foreground is not an 8-bit mask of the image's size");
      bool binary = mask.type() == CV_8UC1;
      for (int y = 0; binary && y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
          const uchar v = mask.at<uchar>(y, x);
          binary = binary && (v == 0 || v == 255);
        }
      }
      findings_.require(binary, "the foreground has values other than 0 and 255");
    }
    check_pictures(*prepared.evidence, image.size());
    const std::vector<double> reference = matched(*modality_, *prepared.evidence, camera);
    for (const double v : reference) {
      findings_.require(std::isfinite(v) || std::isnan(v), "match() gives an infinite likelihood");
    }
    findings_.require(same(reference, matched(*modality_, *prepared.evidence, camera)),
                      "match() gives another answer the second time");
    in_part(*prepared.evidence, camera, reference);
    concurrently(image, camera, reference);

    const auto none = modality_->sample(shape_, {}, camera);
    findings_.step("match() of no template",
                   [&] { modality_->match(*prepared.evidence, *none, {}); });

    const auto batch = modality_->sample(shape_, poses_, camera);
    const auto last = static_cast<std::uint32_t>(poses_.size() - 1);
    const std::uint32_t two[] = {9, 0};
    const EvidencePtr together = modality_->explain(prepared.evidence, *batch, two);
    const EvidencePtr in_turn =
        modality_->explain(modality_->explain(prepared.evidence, *batch, two[0]), *batch, two[1]);
    findings_.require(
        same(matched(*modality_, *together, camera), matched(*modality_, *in_turn, camera)),
        "explain() of two templates is not explain() of one after the other");
    for (const std::uint32_t i : {std::uint32_t{9}, last}) {
      const EvidencePtr rest = modality_->explain(prepared.evidence, *batch, i);
      findings_.require(same(reference, matched(*modality_, *prepared.evidence, camera)),
                        "explain() changes the evidence that it was given");
      const std::vector<double> after = matched(*modality_, *rest, camera);
      for (const double v : after) {
        findings_.require(std::isfinite(v) || std::isnan(v),
                          "match() gives an infinite likelihood after explain()");
      }
      if (std::isfinite(after[i]) && std::isfinite(reference[i])) {
        findings_.require(after[i] <= reference[i] + 1e-9,
                          "a template is more likely after its evidence was explained");
      }
    }
  }

  void check_pictures(const Evidence& evidence, cv::Size size) {
    std::set<std::string> names;
    for (const Picture& picture : evidence.pictures()) {
      const std::string what = "picture '" + picture.name + "' ";
      const bool file_name = !picture.name.empty() &&
                             picture.name.find_first_not_of(
                                 "abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
      if (!file_name) findings_.add(what + "has a name that makes no file name");
      if (!names.insert(picture.name).second) findings_.add(what + "is there twice");
      if (picture.caption.empty()) findings_.add(what + "has no caption");
      if (picture.image.type() != CV_8UC3 || picture.image.size() != size) {
        findings_.add(what + "is not 8-bit BGR of the view's size");
      }
    }
  }

  void in_part(const Evidence& evidence, std::size_t camera, const std::vector<double>& reference) {
    // backwards, leaving some out, one of them twice
    std::vector<std::uint32_t> which = {static_cast<std::uint32_t>(poses_.size() - 1), 4};
    for (std::size_t i = poses_.size(); i-- > 0;) {
      if (i % 3 != 1) which.push_back(static_cast<std::uint32_t>(i));
    }
    const auto batch = modality_->sample(shape_, poses_, camera);
    std::vector<double> found(which.size()), expected;
    modality_->match(evidence, *batch, which, found);
    for (const std::uint32_t index : which) expected.push_back(reference[index]);
    findings_.require(same(expected, found),
                      "match() of some templates gives other values than match() of all");
  }

  void concurrently(const cv::Mat& image, std::size_t camera,
                    const std::vector<double>& reference) {
    std::vector<std::vector<double>> results(4);
    std::vector<std::thread> threads;
    for (auto& result : results) {
      threads.emplace_back([&] {
        try {
          result = matched(*modality_, *modality_->prepare(image, camera).evidence, camera);
        } catch (const std::exception&) {
          result.clear();
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : results) {
      findings_.require(same(result, reference),
                        "prepare() gives another answer in several threads at once");
    }
  }

  void as_a_node() {
    for (const std::int64_t frame : {std::int64_t{2}, stage_.world().frame_count() / 2}) {
      const auto call = stage_.call(frame);
      if (!findings_.step("a frame with missing views", [&] { modality_->process(call->io()); }))
        continue;
      const auto* evidence = dynamic_cast<const EvidenceSet*>(call->output(0).get());
      if (evidence == nullptr) {
        findings_.add("output 0 is no Evidence");
        continue;
      }
      for (std::size_t c = 0; c < evidence->views.size(); ++c) {
        findings_.require(
            (evidence->views[c] == nullptr) == stage_.world().frames(frame).views[c].empty(),
            "evidence is there where the image is missing, or the other way round");
      }
    }
  }

  /// What a node gives follows from its frame and, where memory is declared, from what the frame
  /// before left: its mask, whose chain a missing image breaks, and what else was handed on.
  void with_memory() {
    if (stage_.declaration().outputs.size() < 2) return;
    const auto node = stage_.make_as<Modality>();
    std::vector<Modality::Past> before(stage_.scene().cameras.size());
    const bool remembers = stage_.declaration().memory;
    for (std::int64_t frame = 0; frame < std::min<std::int64_t>(4, stage_.world().frame_count());
         ++frame) {
      const auto call = stage_.call(frame);
      if (!findings_.step("frames in order", [&] { node->process(call->io()); })) return;
      const auto* masks = dynamic_cast<const ForegroundMask*>(call->output(1).get());
      if (masks == nullptr || masks->views.size() != before.size()) {
        findings_.add("output 1 is no ForegroundMask of all views");
        return;
      }
      for (std::size_t c = 0; c < before.size(); ++c) {
        const cv::Mat& image = stage_.world().frames(frame).views[c];
        Modality::Prepared expected;
        if (!image.empty()) expected = modality_->prepare(image, c, before[c]);
        findings_.require(same_mask(masks->views[c], expected.foreground),
                          "the node's foreground is not that of prepare() with what the frame "
                          "before left");
        if (!image.empty()) {
          findings_.require(
              same_mask(modality_->prepare(image, c, before[c]).foreground, expected.foreground),
              "prepare() gives another answer when it is given the same past again");
        }
        findings_.require(remembers || expected.memory == nullptr,
                          "prepare() hands something on, but no memory is declared");
        if (!remembers) continue;
        before[c].foreground = masks->views[c];
        if (!image.empty()) before[c].memory = expected.memory;
      }
    }
  }

  static bool same_mask(const cv::Mat& a, const cv::Mat& b) {
    if (a.size() != b.size() || a.type() != b.type()) return false;
    for (int y = 0; y < a.rows; ++y) {
      if (!std::equal(a.ptr(y), a.ptr(y) + a.cols * a.elemSize(), b.ptr(y))) return false;
    }
    return true;
  }

  const Stage& stage_;
  Findings& findings_;
  std::shared_ptr<Modality> modality_;
  BoxShape shape_;
  std::vector<Pose> poses_;
};

}  // namespace

void check_modality(const Stage& stage, Findings& findings) {
  ModalityCheck(stage, findings).run();
}

}  // namespace plaza::contract
