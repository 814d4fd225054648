#include "framework/config/json_document.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using nlohmann::json;

/// Follows the parser through the text. The parser tells of a value when it has read it (a number
/// even one character late), so the place where the value began must be remembered here.
class PositionTracker {
 public:
  void consume(char c) {
    if (in_string_) {
      if (escaped_) {
        escaped_ = false;
      } else if (c == '\\') {
        escaped_ = true;
      } else if (c == '"') {
        in_string_ = false;
      }
    } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      in_word_ = false;
    } else if (c == ',' || c == ':' || c == '}' || c == ']') {
      in_word_ = false;
      token_ = here();
    } else if (c == '"' || c == '{' || c == '[') {
      in_string_ = c == '"';
      in_word_ = false;
      token_ = value_ = here();
    } else if (!in_word_) {
      in_word_ = true;
      token_ = value_ = here();
    }
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
      ++column_;  // continuation bytes belong to the character before them
    }
  }

  std::pair<int, int> here() const { return {line_, column_}; }
  std::pair<int, int> value() const { return value_; }  ///< where the last value or key began
  std::pair<int, int> token() const { return token_; }  ///< the same, punctuation included

 private:
  int line_ = 1;
  int column_ = 1;
  bool in_string_ = false;
  bool escaped_ = false;
  bool in_word_ = false;
  std::pair<int, int> value_{1, 1};
  std::pair<int, int> token_{1, 1};
};

/// Input iterator that tells the tracker of every character the parser takes.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, PositionTracker* tracker) : at_(at), tracker_(tracker) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    tracker_->consume(*at_);
    ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  PositionTracker* tracker_;
};

/// nlohmann's explanation without what we say ourselves: its own tag and place, and the raw text it
/// read last, which may not even be UTF-8.
std::string explanation(const std::string& what) {
  std::string text = what;
  if (const auto column = text.find(", column "); column != std::string::npos) {
    if (const auto colon = text.find(": ", column); colon != std::string::npos) {
      text.erase(0, colon + 2);
    }
  } else if (const auto tag = text.find("] "); tag != std::string::npos) {
    text.erase(0, tag + 2);
  }
  if (const auto last_read = text.find("; last read: '"); last_read != std::string::npos) {
    const auto expected = text.rfind("'; expected ");
    const auto end =
        expected == std::string::npos || expected < last_read ? text.size() : expected + 1;
    text.erase(last_read, end - last_read);
  }
  return text;
}

/// Builds the document from the parser's events.
class DocumentBuilder {
 public:
  DocumentBuilder(JsonDocument& document, const PositionTracker& tracker)
      : document_(document), tracker_(tracker) {}

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(json::number_integer_t value) { return add(value); }
  bool number_unsigned(json::number_unsigned_t value) { return add(value); }
  bool number_float(json::number_float_t value, const std::string& /*text*/) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(json::binary_t& /*value*/) { throw InternalError("binary value in JSON text"); }

  bool start_object(std::size_t /*count*/) { return open(json::object()); }
  bool end_object() { return close(); }
  bool start_array(std::size_t /*count*/) { return open(json::array()); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Level& level = levels_.back();
    if (name.size() > kMaxJsonKeyBytes) {
      fail(tracker_.value(), "key is longer than " + std::to_string(kMaxJsonKeyBytes) + " bytes");
      return false;
    }
    level.key = name;
    const std::string pointer = level.pointer + "/" + pointer_token(name);
    const auto [first, fresh] = document_.keys.try_emplace(pointer, at(tracker_.value()));
    if (!fresh) {
      diagnostics_.push_back({at(tracker_.value()), pointer,
                              "duplicate key \"" + name + "\"; the first one is at " +
                                  std::to_string(first->second.line) + ":" +
                                  std::to_string(first->second.column)});
    }
    return true;
  }

  bool parse_error(std::size_t /*position*/, const std::string& last_token,
                   const json::exception& error) {
    std::string message = explanation(error.what());
    if (error.id == 406) message = "number " + last_token + " is too large";
    const bool at_end = message.find("unexpected end of input") != std::string::npos;
    fail(at_end ? tracker_.here() : tracker_.token(), message);
    return false;
  }

  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  struct Level {
    json* container;
    std::string pointer;
    std::string key;  ///< of the member being read
  };

  FilePosition at(std::pair<int, int> place) const {
    return {document_.file, place.first, place.second};
  }
  void fail(std::pair<int, int> place, std::string message) {
    diagnostics_.push_back(
        {at(place), levels_.empty() ? "" : levels_.back().pointer, std::move(message)});
  }

  /// Puts a value into its container and notes where it began.
  json* place(json value, std::string& pointer) {
    json* slot = &document_.root;
    if (!levels_.empty()) {
      Level& level = levels_.back();
      if (level.container->is_object()) {
        pointer = level.pointer + "/" + pointer_token(level.key);
        slot = &(*level.container)[level.key];
      } else {
        pointer = level.pointer + "/" + std::to_string(level.container->size());
        level.container->push_back(nullptr);
        slot = &level.container->back();
      }
    }
    *slot = std::move(value);
    document_.values.insert_or_assign(pointer, at(tracker_.value()));
    return slot;
  }
  bool add(json value) {
    std::string pointer;
    place(std::move(value), pointer);
    return true;
  }
  bool open(json value) {
    if (levels_.size() >= kMaxJsonDepth) {
      fail(tracker_.value(), "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
      return false;
    }
    std::string pointer;
    json* slot = place(std::move(value), pointer);
    levels_.push_back({slot, std::move(pointer), {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  JsonDocument& document_;
  const PositionTracker& tracker_;
  std::vector<Level> levels_;
  Diagnostics diagnostics_;
};

FilePosition find_upwards(const JsonDocument& document, std::string_view pointer) {
  while (true) {
    if (const auto it = document.values.find(pointer); it != document.values.end())
      return it->second;
    const auto slash = pointer.rfind('/');
    if (slash == std::string_view::npos) return {document.file, 0, 0};
    pointer = pointer.substr(0, slash);
  }
}

}  // namespace

FilePosition JsonDocument::position(std::string_view pointer) const {
  return find_upwards(*this, pointer);
}

FilePosition JsonDocument::key_position(std::string_view pointer) const {
  if (const auto it = keys.find(pointer); it != keys.end()) return it->second;
  return position(pointer);
}

JsonDocument parse_json(std::string_view text, const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());

  JsonDocument document;
  document.file = file;
  PositionTracker tracker;
  DocumentBuilder builder(document, tracker);
  const bool parsed =
      json::sax_parse(CountingIterator(text.data(), &tracker),
                      CountingIterator(text.data() + text.size(), &tracker), &builder);
  if (!builder.diagnostics().empty()) throw UserError(builder.diagnostics());
  if (!parsed) throw InternalError("JSON parser failed without an error in " + file);
  return document;
}

std::string read_text_file(const std::filesystem::path& file) {
  const auto refuse = [&file](const std::string& message) {
    Diagnostic diagnostic;
    diagnostic.where.file = file.string();
    diagnostic.message = message;
    return UserError(std::move(diagnostic));
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw refuse("no such file");
  if (std::filesystem::is_directory(status)) throw refuse("is a folder, expected a JSON file");
  if (!std::filesystem::is_regular_file(status)) throw refuse("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw refuse("can't be read: " + error.message());
  if (size > kMaxJsonFileBytes) {
    throw refuse("has " + std::to_string(size) + " bytes, more than the " +
                 std::to_string(kMaxJsonFileBytes) + " that a JSON file may have");
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.is_open() || in.bad()) {
    throw refuse("can't be read: " + std::string(std::strerror(errno == 0 ? EIO : errno)));
  }
  return text;
}

JsonDocument read_json(const std::filesystem::path& file) {
  return parse_json(read_text_file(file), file.string());
}

std::string pointer_token(std::string_view key) {
  std::string out;
  for (const char c : key) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

std::vector<std::string> pointer_tokens(std::string_view pointer) {
  std::vector<std::string> out;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);  // the slash
    const std::string_view token = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(token.size());
    std::string& text = out.emplace_back();
    for (std::size_t i = 0; i < token.size(); ++i) {
      const bool escape =
          token[i] == '~' && i + 1 < token.size() && (token[i + 1] == '0' || token[i + 1] == '1');
      if (!escape) {
        text += token[i];
      } else {
        text += token[++i] == '0' ? '~' : '/';
      }
    }
  }
  return out;
}

}  // namespace plaza
