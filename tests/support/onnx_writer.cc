#include "tests/support/onnx_writer.h"

#include <cstring>

namespace plaza::test {
namespace {

// The wire format of protocol buffers: each field is its number and kind, then its value. Field
// numbers are those of onnx.proto.
constexpr int kFloat = 1;
constexpr int kInt64 = 7;

std::string varint(std::uint64_t value) {
  std::string out;
  while (value >= 0x80) {
    out += static_cast<char>((value & 0x7f) | 0x80);
    value >>= 7;
  }
  return out + static_cast<char>(value);
}

std::string number(int field, std::int64_t value) {
  return varint(static_cast<std::uint64_t>(field) << 3) + varint(static_cast<std::uint64_t>(value));
}

std::string text(int field, std::string_view bytes) {
  return varint(static_cast<std::uint64_t>(field) << 3 | 2) + varint(bytes.size()) +
         std::string(bytes);
}

std::string tensor(const std::string& name, const std::vector<std::int64_t>& shape, int type,
                   std::string_view raw) {
  std::string out;
  for (const std::int64_t size : shape) out += number(1, size);
  return out + number(2, type) + text(8, name) + text(9, raw);
}

template <class T>
std::string raw_bytes(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(out.data(), values.data(), out.size());
  return out;
}

std::string value_info(const std::string& name, const std::vector<std::int64_t>& shape) {
  std::string dimensions;
  for (const std::int64_t size : shape) {
    dimensions += text(1, size < 0 ? text(2, "open") : number(1, size));
  }
  const std::string type = number(1, kFloat) + text(2, dimensions);
  return text(1, name) + text(2, text(1, type));
}

}  // namespace

void OnnxWriter::real(const std::string& name, const std::vector<std::int64_t>& shape,
                      const std::vector<float>& values) {
  constants_ += text(5, tensor(name, shape, kFloat, raw_bytes(values)));
}

void OnnxWriter::whole(const std::string& name, const std::vector<std::int64_t>& values) {
  const auto size = static_cast<std::int64_t>(values.size());
  constants_ += text(5, tensor(name, {size}, kInt64, raw_bytes(values)));
}

void OnnxWriter::node(std::string_view type, const std::vector<std::string>& inputs,
                      const std::string& output, const std::vector<Attribute>& attributes) {
  constexpr int kOne = 2;
  constexpr int kList = 7;
  std::string out;
  for (const std::string& input : inputs) out += text(1, input);
  out += text(2, output) + text(3, "node" + std::to_string(++count_)) + text(4, type);
  for (const Attribute& a : attributes) {
    std::string body = text(1, a.name) + number(20, a.single ? kOne : kList);
    for (const std::int64_t v : a.values) body += number(a.single ? 3 : 8, v);
    out += text(5, body);
  }
  nodes_ += text(1, out);
}

void OnnxWriter::output(const std::string& name, const std::vector<std::int64_t>& shape) {
  outputs_ += text(12, value_info(name, shape));
}

std::string OnnxWriter::bytes() const {
  const std::string graph = nodes_ + text(2, "test") + constants_ +
                            text(11, value_info("images", input_shape_)) + outputs_;
  return number(1, 7) + text(2, "plaza tests") + text(7, graph) + text(8, number(2, 12));
}

}  // namespace plaza::test
