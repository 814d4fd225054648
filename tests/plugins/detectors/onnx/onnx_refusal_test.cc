// What is wrong with a model is said by the check, before anything is computed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plaza/core/error.h"
#include "plugins/detectors/onnx/onnx_detector.h"
#include "tests/plugins/detectors/onnx/onnx_scene.h"
#include "tests/support/onnx_writer.h"

namespace plaza {
namespace {

using test::BlobNetwork;
using test::OnnxWriter;
using ::testing::AllOf;
using ::testing::HasSubstr;

class OnnxRefusalTest : public ::testing::Test {
 protected:
  std::filesystem::path model(const std::string& bytes) {
    return options_.model = folder_.write("model.onnx", bytes);
  }
  /// The only fault that the check finds, as "/pointer: message".
  std::string fault() const {
    const OnnxDetector detector(options_, testing::context_of(testing::street()));
    const Diagnostics faults = detector.check();
    return faults.size() == 1 ? to_string(faults[0]) : std::to_string(faults.size()) + " faults";
  }
  static std::string sigmoid_of(const std::vector<std::int64_t>& shape) {
    OnnxWriter model(shape);
    model.node("Sigmoid", {"images"}, "scores");
    model.output("scores", shape);
    return model.bytes();
  }

  test::TemporaryFolder folder_;
  OnnxDetector::Options options_;
};

TEST_F(OnnxRefusalTest, AcceptsAModelThatIsRight) {
  model(BlobNetwork().bytes());
  EXPECT_EQ(fault(), "0 faults");
}

TEST_F(OnnxRefusalTest, AModelThatIsMissing) {
  options_.model = folder_ / "none.onnx";
  EXPECT_THAT(fault(), AllOf(HasSubstr("/model: there is no file"), HasSubstr("none.onnx")));
  options_.model = folder_.path();
  EXPECT_THAT(fault(), HasSubstr("is not a file"));
}

TEST_F(OnnxRefusalTest, AFileThatIsNoModelOrCutOff) {
  for (const std::string& bytes : {std::string(), std::string("<html>not found</html>"),
                                   std::string(4000, '\7'), BlobNetwork().bytes().substr(0, 500)}) {
    model(bytes);
    EXPECT_THAT(fault(), AllOf(HasSubstr("/model: "), HasSubstr("no ONNX model, or was cut off")));
  }
}

TEST_F(OnnxRefusalTest, AnOperatorThatOpenCvLacks) {
  OnnxWriter writer({1, 3, 64, 64});
  writer.node("NonMaxSuppression", {"images"}, "kept");
  writer.output("kept", {1, 100, 3});
  model(writer.bytes());
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(fault(), AllOf(HasSubstr("/model: OpenCV 4"), HasSubstr("type \"NonMaxSuppression\""),
                             HasSubstr("operator set 12")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(OnnxRefusalTest, OutputsThatAreNoHeads) {
  model(sigmoid_of({1, 3, 64, 64}));
  EXPECT_THAT(fault(), AllOf(HasSubstr("/head: "), HasSubstr("\"scores\" is [1, 3, 64, 64]"),
                             HasSubstr("[1, 4 + classes, boxes]")));
  options_.head = Head::kSsd;
  EXPECT_THAT(fault(), HasSubstr("[1, 3, 64, 64] where head \"ssd\" has [1, 1, boxes, 7]"));
}

TEST_F(OnnxRefusalTest, AHeadThatTheModelHasNot) {
  model(BlobNetwork().bytes());
  options_.head = Head::kYolov5;
  EXPECT_THAT(fault(), AllOf(HasSubstr("[1, 6, 64] where head \"yolov5\""),
                             HasSubstr("the other way round")));
}

TEST_F(OnnxRefusalTest, AClassThatTheModelHasNot) {
  model(BlobNetwork().bytes());
  options_.person_class = 2;
  EXPECT_THAT(fault(), HasSubstr("it has 2 classes, so there is no class 2"));
}

TEST_F(OnnxRefusalTest, AHeadThatIsNotClear) {
  BlobNetwork network;
  network.head = BlobNetwork::Head::kYolov5;
  network.classes.resize(1);
  model(network.bytes());
  EXPECT_THAT(fault(), HasSubstr("[1, 64, 6], which is not clearly one of"));
  options_.head = Head::kYolov5;
  EXPECT_EQ(fault(), "0 faults");
}

TEST_F(OnnxRefusalTest, AnInputSizeThatTheModelHasNot) {
  const auto file = model(BlobNetwork().bytes()).string();
  options_.input_size = {96, 64};
  EXPECT_EQ(fault(), "/input_size: " + file +
                         " takes images of 64x64, not 96x64; leave \"input_size\" out, or export "
                         "the model for that size");
}

TEST_F(OnnxRefusalTest, AnInputSizeThatNobodySays) {
  BlobNetwork network;
  network.open_size = true;
  model(network.bytes());
  EXPECT_THAT(fault(), HasSubstr("/input_size: "));
  EXPECT_THAT(fault(), HasSubstr("leaves the size of its input open"));
}

TEST_F(OnnxRefusalTest, AnInputSizeThatTheNetworkCanNotTake) {
  BlobNetwork network;  // it says that it takes any size, but reshapes to that of 64 x 64
  network.open_size = true;
  model(network.bytes());
  options_.input_size = {128, 128};
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(fault(), AllOf(HasSubstr("/input_size: OpenCV"), HasSubstr("[1, 3, 128, 128]"),
                             HasSubstr("exported for")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(OnnxRefusalTest, InputsThatAreNoImage) {
  model(sigmoid_of({1, 64, 64, 3}));
  EXPECT_THAT(fault(), AllOf(HasSubstr("[1, 64, 64, 3]"), HasSubstr("channels first")));
  model(sigmoid_of({1, 3, 64, 100000}));
  EXPECT_THAT(fault(), HasSubstr("takes images of 100000x64; at most 8192"));
  model(sigmoid_of({8, 3, 64, 64}));
  EXPECT_THAT(fault(), HasSubstr("batch of one"));
  OnnxWriter writer({1, 3, 8, 8});
  writer.real("images", {1}, {0});
  model(writer.bytes());
  EXPECT_THAT(fault(), HasSubstr("has 0 inputs"));
}

/// Two outputs that both look like YOLOv8's, as models have that keep their intermediate results.
std::string two_heads() {
  OnnxWriter model({1, 3, 8, 8});
  model.whole("shape", {1, 6, 32});
  model.node("Reshape", {"images", "shape"}, "a");
  model.node("Sigmoid", {"a"}, "b");
  model.node("Sigmoid", {"a"}, "c");
  model.output("b", {1, 6, 32});
  model.output("c", {1, 6, 32});
  return model.bytes();
}

TEST_F(OnnxRefusalTest, SeveralOutputsOfWhichNoneIsNamed) {
  model(two_heads());
  EXPECT_THAT(fault(), AllOf(HasSubstr("/output: "), HasSubstr("\"b\" [1, 6, 32], \"c\"")));
  options_.output = "c";
  EXPECT_EQ(fault(), "0 faults");
  options_.output = "d";
  EXPECT_THAT(fault(), AllOf(HasSubstr("no output \"d\""), HasSubstr("\"b\"")));
}

}  // namespace
}  // namespace plaza
