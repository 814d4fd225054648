#include "plugins/detectors/onnx/model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/blob_network.h"
#include "tests/support/onnx_writer.h"

namespace plaza {
namespace {

using ::testing::ElementsAre;

std::string sigmoid_model(const std::vector<std::int64_t>& shape) {
  test::OnnxWriter model(shape);
  model.node("Sigmoid", {"images"}, "scores");
  model.output("scores", shape);
  return model.bytes();
}

TEST(DeclaredInputs, AreThoseOfTheFile) {
  const auto inputs = declared_inputs(sigmoid_model({1, 3, 480, 640}));
  ASSERT_TRUE(inputs);
  ASSERT_EQ(inputs->size(), 1U);
  EXPECT_EQ(inputs->front().name, "images");
  EXPECT_THAT(inputs->front().shape, ElementsAre(1, 3, 480, 640));
}

TEST(DeclaredInputs, KnowWhatIsLeftOpen) {
  const auto inputs = declared_inputs(sigmoid_model({-1, 3, -1, 640}));
  ASSERT_TRUE(inputs);
  EXPECT_THAT(inputs->front().shape, ElementsAre(-1, 3, -1, 640));
}

TEST(DeclaredInputs, AreNoConstants) {
  test::OnnxWriter model({1, 3, 8, 8});
  model.real("images", {1}, {0});  // a constant that is declared as an input, as of old
  EXPECT_TRUE(declared_inputs(model.bytes())->empty());
}

TEST(DeclaredInputs, AreNotReadFromWhatIsCutOffOrSomethingElse) {
  const std::string whole = test::BlobNetwork().bytes();
  const std::size_t behind_graph = 4;  // the operator set, after the graph
  ASSERT_TRUE(declared_inputs(whole));
  for (std::size_t size = 0; size + behind_graph < whole.size(); ++size) {
    ASSERT_FALSE(declared_inputs(whole.substr(0, size))) << size;
  }
  EXPECT_FALSE(declared_inputs("<html>404: not found</html>"));
  EXPECT_FALSE(declared_inputs(std::string(1000, '\0')));
  EXPECT_FALSE(declared_inputs(std::string(1000, '\xff')));
}

TEST(DeclaredInputs, SurviveAnyDamage) {
  const std::string whole = sigmoid_model({1, 3, 48, 64});
  std::mt19937 random(5);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    if (!declared_inputs(damaged)) ++refused;
  }
  EXPECT_GT(refused, 500);  // most others changed a name or a size
}

}  // namespace
}  // namespace plaza
