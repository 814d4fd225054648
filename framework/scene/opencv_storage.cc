#include "framework/scene/opencv_storage.h"

#include <yaml.h>

#include <memory>
#include <pugixml.hpp>

#include "framework/config/json_document.h"
#include "framework/scene/fields.h"
#include "framework/scene/text_position.h"
#include "plaza/core/error.h"

namespace plaza {
namespace {

constexpr std::size_t kMaxNumbers = 1000;  // no calibration matrix has more
constexpr int kMaxDepth = 4;

void append(StorageValue& value, std::string_view text) {
  const auto number = parse_number(text);
  value.numeric = value.numeric && number && value.numbers.size() < kMaxNumbers;
  if (value.numeric) value.numbers.push_back(*number);
}

Storage from_json(std::string_view text, const std::string& file) {
  const JsonDocument document = parse_json(text, file);
  if (!document.root.is_object()) throw_fault({file, 1, 1}, "must be an object");
  Storage out;
  for (const auto& [key, item] : document.root.items()) {
    StorageValue value{
        key, document.position(std::string(1, '/').append(pointer_token(key))), {}, true};
    const bool matrix = item.is_object() && item.contains("data");
    const auto numbers = flat_numbers(matrix ? item.at("data") : item);
    value.numeric = numbers && numbers->size() <= kMaxNumbers;
    if (value.numeric) value.numbers = *numbers;
    out.emplace(value.name, value);
  }
  return out;
}

Storage from_xml(std::string_view text, const std::string& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) {
    throw_fault(text_position(text, static_cast<std::size_t>(result.offset), file),
                std::string("not XML: ") + result.description());
  }
  const pugi::xml_node root = document.child("opencv_storage");
  if (!root) throw_fault({file, 1, 1}, "no element <opencv_storage>");
  Storage out;
  for (const pugi::xml_node& node : root.children()) {
    if (node.type() != pugi::node_element) continue;
    const std::ptrdiff_t offset = node.offset_debug();
    StorageValue value{node.name(),
                       text_position(text, offset < 0 ? 0 : static_cast<std::size_t>(offset), file),
                       {},
                       true};
    const pugi::xml_node data = node.child("data");
    const std::string_view content = data ? data.child_value() : node.child_value();
    constexpr std::string_view kBlank = " \t\r\n";
    for (std::size_t at = content.find_first_not_of(kBlank); at != std::string_view::npos;) {
      const std::size_t end = std::min(content.find_first_of(kBlank, at), content.size());
      append(value, content.substr(at, end - at));
      at = content.find_first_not_of(kBlank, end);
    }
    value.numeric = value.numeric && !value.numbers.empty();
    out.emplace(value.name, value);
  }
  return out;
}

class YamlDocument {
 public:
  YamlDocument(const std::string& text, const std::string& file) {
    yaml_parser_initialize(&parser_);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
    loaded_ = yaml_parser_load(&parser_, &document_) != 0;
    if (!loaded_) {
      const FilePosition where{file, static_cast<int>(parser_.problem_mark.line) + 1,
                               static_cast<int>(parser_.problem_mark.column) + 1};
      const std::string message =
          std::string("not YAML: ") + (parser_.problem != nullptr ? parser_.problem : "unreadable");
      yaml_parser_delete(&parser_);
      throw_fault(where, message);
    }
  }
  ~YamlDocument() {
    yaml_document_delete(&document_);
    yaml_parser_delete(&parser_);
  }
  YamlDocument(const YamlDocument&) = delete;
  YamlDocument& operator=(const YamlDocument&) = delete;

  yaml_node_t* root() { return yaml_document_get_root_node(&document_); }
  yaml_node_t* node(int index) { return yaml_document_get_node(&document_, index); }

  static std::string_view scalar(const yaml_node_t& node) {
    if (node.type != YAML_SCALAR_NODE) return {};
    return {reinterpret_cast<const char*>(node.data.scalar.value), node.data.scalar.length};
  }

  yaml_node_t* member(const yaml_node_t& map, std::string_view key) {
    for (auto* pair = map.data.mapping.pairs.start; pair < map.data.mapping.pairs.top; ++pair) {
      if (scalar(*node(pair->key)) == key) return node(pair->value);
    }
    return nullptr;
  }

  void append_all(const yaml_node_t& from, StorageValue& value, int depth = 0) {
    if (from.type == YAML_SCALAR_NODE) return append(value, scalar(from));
    // aliases can make a sequence contain itself
    value.numeric = value.numeric && from.type == YAML_SEQUENCE_NODE && depth < kMaxDepth;
    if (!value.numeric) return;
    for (auto* item = from.data.sequence.items.start;
         item < from.data.sequence.items.top && value.numeric; ++item) {
      append_all(*node(*item), value, depth + 1);
    }
  }

 private:
  yaml_parser_t parser_{};
  yaml_document_t document_{};
  bool loaded_ = false;
};

Storage from_yaml(std::string_view text, const std::string& file) {
  std::string standard(text);
  // OpenCV 2 to 4 write a first line that is not YAML
  if (standard.starts_with("%YAML:"))
    standard.replace(0, standard.find_first_of("\r\n"), "%YAML 1.1");
  YamlDocument document(standard, file);
  const yaml_node_t* root = document.root();
  if (root == nullptr || root->type != YAML_MAPPING_NODE) {
    throw_fault({file, 1, 1}, "must hold keys and values");
  }
  Storage out;
  for (auto* pair = root->data.mapping.pairs.start; pair < root->data.mapping.pairs.top; ++pair) {
    const yaml_node_t& key = *document.node(pair->key);
    const yaml_node_t* from = document.node(pair->value);
    StorageValue value{std::string(YamlDocument::scalar(key)),
                       {file, static_cast<int>(key.start_mark.line) + 1,
                        static_cast<int>(key.start_mark.column) + 1},
                       {},
                       true};
    if (from->type == YAML_MAPPING_NODE) {
      if (const yaml_node_t* data = document.member(*from, "data")) from = data;
    }
    document.append_all(*from, value);
    out.emplace(value.name, value);
  }
  return out;
}

}  // namespace

Storage parse_opencv_storage(std::string_view text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const char sign = first == std::string_view::npos ? '\0' : text[first];
  if (sign == '{') return from_json(text, file);
  if (sign == '<') return from_xml(text, file);
  if (sign == '\0') throw_fault({file, 1, 1}, "the file is empty");
  return from_yaml(text, file);
}

}  // namespace plaza
