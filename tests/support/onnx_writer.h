#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plaza::test {

/// Writes ONNX models, operator set 12, without any library: what tests of networks need of it.
///
///   OnnxWriter model({1, 3, 32, 32});                    // the input "images"
///   model.real("weights", {1, 3, 4, 4}, values);
///   model.node("Conv", {"images", "weights"}, "cells", {{"strides", {4, 4}}});
///   write(model.bytes("cells", {1, 1, 8, 8}));
class OnnxWriter {
 public:
  /// An attribute of integers: a list, or with `single` one of them.
  struct Attribute {
    std::string name;
    std::vector<std::int64_t> values;
    bool single = false;
  };

  /// `input_shape` of the tensor "images"; -1 is a size that the model leaves open.
  explicit OnnxWriter(std::vector<std::int64_t> input_shape)
      : input_shape_(std::move(input_shape)) {}

  /// A constant tensor.
  void real(const std::string& name, const std::vector<std::int64_t>& shape,
            const std::vector<float>& values);
  void whole(const std::string& name, const std::vector<std::int64_t>& values);

  /// An operator with one output.
  void node(std::string_view type, const std::vector<std::string>& inputs,
            const std::string& output, const std::vector<Attribute>& attributes = {});

  /// Declares an output of the model.
  void output(const std::string& name, const std::vector<std::int64_t>& shape);

  /// The file's content.
  std::string bytes() const;

 private:
  std::vector<std::int64_t> input_shape_;
  std::string nodes_;
  std::string constants_;
  std::string outputs_;
  int count_ = 0;
};

}  // namespace plaza::test
