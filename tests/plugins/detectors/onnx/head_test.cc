#include "plugins/detectors/onnx/head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using ::testing::HasSubstr;

cv::Mat tensor(const TensorShape& shape, std::vector<float> values) {
  return cv::Mat(shape, CV_32F, values.data()).clone();
}

/// Boxes of 4 + 2 values each, in YOLOv8's order: value after value.
cv::Mat yolov8(const std::vector<std::vector<float>>& boxes) {
  std::vector<float> values;
  for (std::size_t v = 0; v < boxes[0].size(); ++v) {
    for (const auto& box : boxes) values.push_back(box[v]);
  }
  return tensor({1, static_cast<int>(boxes[0].size()), static_cast<int>(boxes.size())}, values);
}

cv::Mat rows(const std::vector<std::vector<float>>& boxes, bool ssd) {
  std::vector<float> values;
  for (const auto& box : boxes) values.insert(values.end(), box.begin(), box.end());
  const int count = static_cast<int>(boxes.size());
  return ssd ? tensor({1, 1, count, 7}, values)
             : tensor({1, count, static_cast<int>(boxes[0].size())}, values);
}

std::string refusal(Head head, const cv::Mat& output) {
  try {
    people_in(head, output, {100, 100}, 0, 0.25);
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HeadOf, IsToldByTheShape) {
  EXPECT_EQ(head_of({1, 84, 8400}), Head::kYolov8);
  EXPECT_EQ(head_of({1, 5, 8400}), Head::kYolov8);
  EXPECT_EQ(head_of({1, 25200, 85}), Head::kYolov5);
  EXPECT_EQ(head_of({1, 25200, 7}), Head::kYolov5);
  EXPECT_EQ(head_of({1, 1, 100, 7}), Head::kSsd);
}

TEST(HeadOf, IsNotGuessed) {
  EXPECT_EQ(head_of({1, 300, 6}), std::nullopt);  // one class, or corners, score and class
  EXPECT_EQ(head_of({1, 84, 84}), std::nullopt);
  EXPECT_EQ(head_of({2, 84, 8400}), std::nullopt);
  EXPECT_EQ(head_of({1, 4, 8400}), std::nullopt);
  EXPECT_EQ(head_of({1, 1, 100, 6}), std::nullopt);
  EXPECT_EQ(head_of({1, 255, 80, 80}), std::nullopt);
  EXPECT_EQ(head_of({}), std::nullopt);
}

TEST(ShapeFault, NamesWhatWasFoundAndWhatWasExpected) {
  EXPECT_EQ(shape_fault(Head::kYolov8, {1, 84, 8400}, 79), "");
  EXPECT_THAT(shape_fault(Head::kYolov8, {1, 84, 8400}, 80), HasSubstr("80 classes"));
  EXPECT_THAT(shape_fault(Head::kYolov8, {1, 8400, 84}, 0), HasSubstr("the other way round"));
  EXPECT_THAT(shape_fault(Head::kYolov5, {1, 84, 8400}, 0), HasSubstr("the other way round"));
  EXPECT_EQ(shape_fault(Head::kYolov5, {1, 300, 6}, 0), "");
  EXPECT_EQ(shape_fault(Head::kSsd, {1, 25200, 85}, 0),
            "[1, 25200, 85] where head \"ssd\" has [1, 1, boxes, 7]");
  EXPECT_EQ(shape_fault(Head::kYolov5, {1, 255, 80, 80}, 0),
            "[1, 255, 80, 80] where head \"yolov5\" has [1, boxes, 5 + classes]");
}

TEST(PeopleIn, ReadsYolov8) {
  const auto people = people_in(Head::kYolov8,
                                yolov8({{50, 40, 10, 20, 0.9F, 0.1F},
                                        {60, 40, 10, 20, 0.2F, 0.1F},      // weak
                                        {70, 40, 10, 20, 0.6F, 0.7F},      // rather the other class
                                        {30, 41, 11, 21, 0.25F, 0.25F}}),  // a tie
                                {100, 100}, 0, 0.25);
  ASSERT_EQ(people.size(), 2U);
  EXPECT_DOUBLE_EQ(people[0].left, 45);
  EXPECT_DOUBLE_EQ(people[0].top, 30);
  EXPECT_DOUBLE_EQ(people[0].right, 55);
  EXPECT_DOUBLE_EQ(people[0].bottom, 50);
  EXPECT_FLOAT_EQ(static_cast<float>(people[0].score), 0.9F);
  EXPECT_DOUBLE_EQ(people[1].left, 24.5);
}

TEST(PeopleIn, ReadsTheClassThatIsAskedFor) {
  const cv::Mat output = yolov8({{50, 40, 10, 20, 0.9F, 0.1F}, {70, 40, 10, 20, 0.6F, 0.7F}});
  const auto people = people_in(Head::kYolov8, output, {100, 100}, 1, 0.25);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_DOUBLE_EQ(people[0].left, 65);
}

TEST(PeopleIn, MultipliesYolov5sObjectness) {
  const auto people = people_in(Head::kYolov5,
                                rows({{50, 40, 10, 20, 0.5F, 0.8F, 0.1F},
                                      {60, 40, 10, 20, 0.3F, 0.8F, 0.1F},
                                      {70, 40, 10, 20, 0.9F, 0.6F, 0.7F}},
                                     false),
                                {100, 100}, 0, 0.25);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_NEAR(people[0].score, 0.4, 1e-6);
  EXPECT_DOUBLE_EQ(people[0].bottom, 50);
}

TEST(PeopleIn, ReadsSsdInSharesOfTheInput) {
  const auto people = people_in(Head::kSsd,
                                rows({{0, 15, 0.9F, 0.25F, 0.5F, 0.5F, 0.75F},
                                      {0, 14, 0.9F, 0.25F, 0.5F, 0.5F, 0.75F},
                                      {0, 15, 0.1F, 0.25F, 0.5F, 0.5F, 0.75F},
                                      {-1, 15, 0.9F, 0.25F, 0.5F, 0.5F, 0.75F}},
                                     true),
                                {200, 100}, 15, 0.25);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_DOUBLE_EQ(people[0].left, 50);
  EXPECT_DOUBLE_EQ(people[0].top, 50);
  EXPECT_DOUBLE_EQ(people[0].right, 100);
  EXPECT_DOUBLE_EQ(people[0].bottom, 75);
}

TEST(PeopleIn, RefusesWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal(Head::kYolov8, yolov8({{50, 40, 10, 20, 0.1F, nan}})),
              HasSubstr("nan as value 5 of its output [1, 6, 1]"));
  EXPECT_THAT(refusal(Head::kYolov5, rows({{infinity, 40, 10, 20, 0.1F, 0.1F}}, false)),
              HasSubstr("inf as value 0"));
}

TEST(PeopleIn, RefusesRawValuesInPlaceOfScores) {
  EXPECT_THAT(refusal(Head::kYolov8, yolov8({{50, 40, 10, 20, 7.5F, 0}})),
              HasSubstr("a score of a class of 7.5 (box 0)"));
  EXPECT_THAT(refusal(Head::kYolov5, rows({{50, 40, 10, 20, -3, 0.5F}}, false)),
              HasSubstr("an objectness of -3"));
  EXPECT_THAT(refusal(Head::kSsd, rows({{0, 0, 40, 0, 0, 1, 1}}, true)), HasSubstr("40"));
}

}  // namespace
}  // namespace plaza
