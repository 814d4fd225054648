#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plaza {

/// A model's input as its file declares it.
struct ModelInput {
  std::string name;
  std::vector<std::int64_t> shape;  ///< -1: left open
};

/// The content of a model's file; throws UserError at "/model" when it can't be read.
std::string read_model_file(const std::filesystem::path& file);

/// The inputs that an ONNX model declares, its constants left out; nothing when `bytes` are no
/// whole ONNX model. Only as much of the format is read as this takes (onnx.proto): OpenCV tells
/// neither the declared shapes nor that an input contradicts them.
std::optional<std::vector<ModelInput>> declared_inputs(std::string_view bytes);

}  // namespace plaza
