// A transform that is patched where edges were taken away, against transforming what is left.
#include "modalities/edges/plane_patch.h"

#include <gtest/gtest.h>

#include <random>

#include "modalities/edges/edges.h"
#include "tests/modalities/edges/upright_box.h"

namespace plaza::edges {
namespace {

/// Boxes of all greys on grey, some over the border.
cv::Mat scribbles(cv::Size size) {
  cv::Mat image(size, CV_8UC3, cv::Scalar::all(90));
  std::mt19937 random(2);
  for (int i = 0; i < 25; ++i) {
    const cv::Rect box(static_cast<int>(random() % 210) - 10, static_cast<int>(random() % 150) - 10,
                       12, 35);
    image(box & cv::Rect({}, size)).setTo(cv::Scalar::all(static_cast<double>(random() % 256)));
  }
  return image;
}

class PlanePatchTest : public ::testing::Test {
 protected:
  PlanePatchTest() {
    context_.scene = test::scene_of({200, 150});
    options_.background = BackgroundMethod::kNone;
    for (int i = 0; i < 100; ++i) {
      poses_.push_back({{0.8 * (i % 10) - 4, 0.8 * (i / 10) - 4}, 0, 1});
    }
  }

  /// Every pixel of every plane and every template's value.
  void expect_as_transformed_anew(const EdgeEvidence& rest, const Edges& edges,
                                  const TemplateBatch& batch) {
    const auto& layout = rest.layout();
    FastTransform transform(layout);
    ByteBlock anew(layout->bytes());
    transform.run(rest.points(), anew);
    for (std::size_t d = 0; d < layout->directions().size(); ++d) {
      for (int y = 0; y < layout->size().height; ++y) {
        for (int x = 0; x < layout->size().width; ++x) {
          ASSERT_EQ(rest.nearness(d, x, y), anew.data()[layout->offset(d, x, y)])
              << "direction " << d << " at " << x << ", " << y;
        }
      }
    }
    const auto& templates = dynamic_cast<const EdgeTemplates&>(batch);
    const ContourMatcher matcher(layout, options_.sigma_px, 3 * options_.sigma_px);
    std::vector<double> values(batch.size());
    edges.match(rest, batch, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!templates.tells(i)) continue;
      ASSERT_EQ(values[i], matcher.log_likelihood(anew.data(), templates, i)) << i;
    }
  }

  BuildContext context_;
  Edges::Options options_;
  std::vector<Pose> poses_;
};

TEST_F(PlanePatchTest, IsTheTransformOfWhatIsLeft) {
  for (const double sigma_px : {1.0, 3.0, 12.0}) {
    options_.sigma_px = sigma_px;
    const Edges edges(options_, context_);
    const EvidencePtr all = edges.prepare(scribbles({200, 150}), 0).evidence;
    const auto batch = edges.sample(test::UprightBox(), poses_, 0);
    std::mt19937 random(5);
    EvidencePtr rest = all;
    std::size_t most = 0, before = dynamic_cast<const EdgeEvidence&>(*all).points().size();
    for (int person = 0; person < 5; ++person) {  // one after the other, apart and overlapping
      std::vector<std::uint32_t> which = {static_cast<std::uint32_t>(random() % 100)};
      if (person == 2) which.push_back(static_cast<std::uint32_t>(random() % 100));
      rest = edges.explain(rest, *batch, which);
      const auto& left = dynamic_cast<const EdgeEvidence&>(*rest);
      expect_as_transformed_anew(left, edges, *batch);
      for (const auto& a : left.patches()) {
        for (const auto& b : left.patches()) {
          EXPECT_TRUE(a == b || (a->valid() & b->valid()).empty()) << "patches are disjoint";
        }
      }
      most = std::max(most, left.patches().size());
      EXPECT_LE(left.points().size(), before);
      before = left.points().size();
    }
    if (sigma_px == 1) {
      EXPECT_GT(most, 1U) << "people apart have patches of their own";
    }
    const auto& first = dynamic_cast<const EdgeEvidence&>(*all);
    EXPECT_LT(before, first.points().size()) << "something was explained";
    EXPECT_TRUE(first.patches().empty()) << "the input stays as it is";
  }
}

TEST_F(PlanePatchTest, NothingToTakeAwayIsNoPatch) {
  const Edges edges(options_, context_);
  const EvidencePtr blank =
      edges.prepare(cv::Mat(150, 200, CV_8UC3, cv::Scalar::all(7)), 0).evidence;
  const auto batch = edges.sample(test::UprightBox(), poses_, 0);
  const EvidencePtr rest = edges.explain(blank, *batch, 50);
  EXPECT_TRUE(dynamic_cast<const EdgeEvidence&>(*rest).patches().empty());
}

}  // namespace
}  // namespace plaza::edges
