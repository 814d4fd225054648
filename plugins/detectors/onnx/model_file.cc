#include "plugins/detectors/onnx/model_file.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <system_error>

#include "plaza/core/error.h"

namespace plaza {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw UserError(fault_at("/model", message));
}

/// One field of a protocol buffer message: a number, or bytes (a text, a list, a message).
struct Field {
  std::uint64_t number = 0;
  std::uint64_t value = 0;
  std::string_view bytes;
};

/// The fields of a message, one by one.
class Message {
 public:
  explicit Message(std::string_view bytes) : rest_(bytes) {}

  /// The next field; nothing at the end, or where the bytes are no message: see broken().
  std::optional<Field> next() {
    if (rest_.empty() || broken_) return std::nullopt;
    const std::uint64_t tag = varint();
    Field field;
    field.number = tag >> 3;
    switch (tag & 7) {
      case 0:
        field.value = varint();
        break;
      case 1:
        field.bytes = take(8);
        break;
      case 2:
        field.bytes = take(varint());
        break;
      case 5:
        field.bytes = take(4);
        break;
      default:
        broken_ = true;
    }
    if (field.number == 0) broken_ = true;
    if (broken_) return std::nullopt;
    return field;
  }
  bool broken() const { return broken_; }

 private:
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    broken_ = true;
    return 0;
  }
  std::string_view take(std::uint64_t size) {
    if (broken_ || size > rest_.size()) {
      broken_ = true;
      return {};
    }
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  std::string_view rest_;
  bool broken_ = false;
};

/// Calls `visit` for each field of the message; false when it is broken, or a visit says so.
bool each_field(std::string_view bytes, const std::function<bool(const Field&)>& visit) {
  Message message(bytes);
  while (const auto field = message.next()) {
    if (!visit(*field)) return false;
  }
  return !message.broken();
}

// Field numbers of onnx.proto.
constexpr std::uint64_t kModelGraph = 7, kGraphConstant = 5, kGraphInput = 11, kConstantName = 8,
                        kInputName = 1, kInputType = 2, kTypeTensor = 1, kTensorShape = 2,
                        kShapeDimension = 1, kDimensionValue = 1;

bool read_dimension(std::string_view bytes, std::vector<std::int64_t>& shape) {
  shape.push_back(-1);
  return each_field(bytes, [&](const Field& field) {
    if (field.number == kDimensionValue) {
      const auto size = static_cast<std::int64_t>(field.value);
      shape.back() = size > 0 ? size : -1;
    }
    return true;
  });
}

bool read_input(std::string_view bytes, ModelInput& input) {
  return each_field(bytes, [&](const Field& field) {
    if (field.number == kInputName) input.name = field.bytes;
    if (field.number != kInputType) return true;
    return each_field(field.bytes, [&](const Field& type) {
      if (type.number != kTypeTensor) return true;
      return each_field(type.bytes, [&](const Field& tensor) {
        if (tensor.number != kTensorShape) return true;
        return each_field(tensor.bytes, [&](const Field& shape) {
          return shape.number != kShapeDimension || read_dimension(shape.bytes, input.shape);
        });
      });
    });
  });
}

}  // namespace

std::string read_model_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    refuse("there is no file " + file.string() +
           "; Plaza ships no model: export one (docs/onnx.md); paths start at the pipeline's "
           "folder, $PLAZA_DATA names the data folder");
  }
  if (!std::filesystem::is_regular_file(status)) {
    refuse(file.string() + " is not a file; name the .onnx file itself");
  }
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  if (!in || content.view().size() != std::filesystem::file_size(file, error) || error) {
    refuse(file.string() + " can't be read; check its permissions and the disk");
  }
  return std::move(content).str();
}

std::optional<std::vector<ModelInput>> declared_inputs(std::string_view bytes) {
  std::vector<ModelInput> inputs;
  std::vector<std::string_view> constants;
  bool graph_seen = false;
  const auto read_graph = [&](const Field& field) {
    if (field.number == kGraphInput) return read_input(field.bytes, inputs.emplace_back());
    if (field.number != kGraphConstant) return true;
    return each_field(field.bytes, [&](const Field& constant) {
      if (constant.number == kConstantName) constants.push_back(constant.bytes);
      return true;
    });
  };
  const bool whole = each_field(bytes, [&](const Field& field) {
    if (field.number != kModelGraph) return true;
    graph_seen = true;
    return each_field(field.bytes, read_graph);
  });
  if (!whole || !graph_seen) return std::nullopt;
  // models of the first versions of the format declare their constants as inputs, too
  std::erase_if(inputs, [&](const ModelInput& input) {
    return std::find(constants.begin(), constants.end(), input.name) != constants.end();
  });
  return inputs;
}

}  // namespace plaza
