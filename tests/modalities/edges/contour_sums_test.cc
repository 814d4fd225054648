// Every instruction set's sums against the definition, point by point.
#include "modalities/edges/contour_sums.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "modalities/edges/templates.h"
#include "plaza/geometry/silhouette.h"

namespace plaza::edges {
namespace {

TEST(ContourSums, AreThoseOfEveryPointWithEveryInstructionSet) {
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  ASSERT_EQ(std::string(sum_contour_versions().front().name), "plain");
  for (int turn = 0; turn < 60; ++turn) {
    std::vector<std::uint8_t> block(5000);
    const std::uint8_t peaks[] = {static_cast<std::uint8_t>(1 + below(255)), 16, 255};
    for (std::uint8_t& b : block) {
      b = below(3) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(1 + below(peaks[0]));
    }
    // few, none, and more than one vector's sums hold
    const std::uint32_t counts[] = {below(30), 0, turn % 6 == 0 ? 3000 + below(2000) : below(9)};
    std::vector<std::uint32_t> begins;
    std::vector<std::uint8_t> lengths;
    ContourSum expected[3];
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::uint32_t run = 0; run < counts[d]; ++run) {
        lengths.push_back(static_cast<std::uint8_t>(turn == 6 ? 16 : 1 + below(kLongestRun)));
        begins.push_back(below(block.size() - 2 * kLongestRun));
        for (std::uint32_t i = 0; i < lengths.back(); ++i) {
          std::uint8_t& nearness = block[begins.back() + i];
          if (turn == 6) nearness = 1;  // the largest sum
          const std::int64_t steps = std::max(0, peaks[d] - nearness);
          expected[d].outliers += nearness == 0 ? 1 : 0;
          expected[d].squares += nearness == 0 ? 0 : static_cast<std::uint64_t>(steps * steps);
        }
      }
    }
    if (turn == 6) {  // bytes changed while they were counted
      std::size_t run = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        expected[d] = {};
        for (std::uint32_t i = 0; i < counts[d]; ++i) {
          expected[d].squares += std::uint64_t{lengths[run++]} * (peaks[d] - 1U) * (peaks[d] - 1U);
        }
      }
    }
    for (const SumContourVersion& version : sum_contour_versions()) {
      ContourSum sums[3] = {{7, 7}, {7, 7}, {7, 7}}, pieces[3];
      version.run(block.data(), {begins.data(), lengths.data(), counts, peaks, 3}, sums);
      std::vector<const std::uint8_t*> bytes;
      for (const std::uint32_t begin : begins) bytes.push_back(block.data() + begin);
      version.run_pieces(bytes.data(), {nullptr, lengths.data(), counts, peaks, 3}, pieces);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_EQ(sums[d], expected[d]) << version.name << ", turn " << turn << ", direction " << d;
        EXPECT_EQ(pieces[d], expected[d]) << version.name << ", turn " << turn;
      }
    }
  }
}

TEST(EdgeTemplates, KeepEveryPointOfTheContourInRuns) {
  const auto layout = std::make_shared<const PlaneLayout>(cv::Size(60, 50), make_directions(4, 6));
  Silhouette s;
  s.inside_share = 1;
  std::mt19937 random(4);
  std::vector<std::vector<int>> expected(4, std::vector<int>(60 * 50, 0));
  const auto add = [&](int x, int y, int direction) {
    const double angle = direction * std::numbers::pi / 4;
    s.contour.push_back(
        {{static_cast<float>(x), static_cast<float>(y)},
         {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}});
    ++expected[static_cast<std::size_t>(direction)][static_cast<std::size_t>(60 * y + x)];
  };
  for (int y = 3; y < 45; ++y) add(20, y, 0);  // longer than a run
  for (int i = 0; i < 300; ++i) {              // some twice
    add(static_cast<int>(random() % 60), static_cast<int>(random() % 50),
        static_cast<int>(random() % 4));
  }
  EdgeTemplates templates(layout);
  templates.add(Silhouette(), {});
  templates.add(s, {});
  EXPECT_FALSE(templates.tells(0));
  EXPECT_TRUE(templates.tells(1));
  EXPECT_EQ(templates.points(1), s.contour.size());
  const ContourRuns runs = templates.runs(1);
  std::size_t run = 0;
  for (std::size_t d = 0; d < 4; ++d) {
    for (const std::size_t end = run + runs.counts[d]; run < end; ++run) {
      for (std::uint32_t i = 0; i < runs.lengths[run]; ++i) {
        const cv::Point p = layout->pixel(d, runs.begins[run] + i);
        --expected[d][static_cast<std::size_t>(60 * p.y + p.x)];
      }
    }
    for (const int left : expected[d]) ASSERT_EQ(left, 0) << d;
  }
  EXPECT_EQ(run, templates.begins(1).size());
  EXPECT_LT(run, s.contour.size() - 38);
}

}  // namespace
}  // namespace plaza::edges
