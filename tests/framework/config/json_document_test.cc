#include "framework/config/json_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "plaza/core/error.h"

namespace plaza {
namespace {

using testing::HasSubstr;

std::string errors_of(const std::string& text) {
  try {
    parse_json(text, "f.json");
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

std::string place(const FilePosition& p) {
  return p.file + ":" + std::to_string(p.line) + ":" + std::to_string(p.column);
}

constexpr const char* kText = R"({
  "a": 1,
  "list": [ 10, -2.5e3,"text", true,
            null, { "deep": [] } ],
  "esc\"aped/key~": "x\\\"y"
})";

TEST(ParseJson, KeepsTheValues) {
  const JsonDocument document = parse_json(kText, "f.json");
  EXPECT_EQ(document.root, nlohmann::json::parse(kText));
  EXPECT_EQ(document.file, "f.json");
}

TEST(ParseJson, KnowsWhereEveryValueAndKeyBegins) {
  const JsonDocument document = parse_json(kText, "f.json");
  EXPECT_EQ(place(document.position("")), "f.json:1:1");
  EXPECT_EQ(place(document.key_position("/a")), "f.json:2:3");
  EXPECT_EQ(place(document.position("/a")), "f.json:2:8");
  EXPECT_EQ(place(document.position("/list")), "f.json:3:11");
  EXPECT_EQ(place(document.position("/list/0")), "f.json:3:13");
  EXPECT_EQ(place(document.position("/list/1")), "f.json:3:17");
  EXPECT_EQ(place(document.position("/list/2")), "f.json:3:24");
  EXPECT_EQ(place(document.position("/list/3")), "f.json:3:32");
  EXPECT_EQ(place(document.position("/list/4")), "f.json:4:13");
  EXPECT_EQ(place(document.position("/list/5")), "f.json:4:19");
  EXPECT_EQ(place(document.key_position("/list/5/deep")), "f.json:4:21");
  EXPECT_EQ(place(document.position("/list/5/deep")), "f.json:4:29");
  EXPECT_EQ(place(document.key_position("/esc\"aped~1key~0")), "f.json:5:3");
  EXPECT_EQ(place(document.position("/esc\"aped~1key~0")), "f.json:5:21");
}

TEST(ParseJson, NumbersThatEndAtTheClosingBraceKeepTheirPlace) {
  const JsonDocument document = parse_json("{\"a\":1}", "f.json");
  EXPECT_EQ(place(document.position("/a")), "f.json:1:6");
  EXPECT_EQ(place(parse_json("  42", "f.json").position("")), "f.json:1:3");
}

TEST(ParseJson, UnknownPointersHaveThePlaceOfTheirNearestAncestor) {
  const JsonDocument document = parse_json(kText, "f.json");
  EXPECT_EQ(document.position("/list/5/other/thing"), document.position("/list/5"));
  EXPECT_EQ(document.key_position("/nothing"), document.position(""));
}

TEST(ParseJson, ColumnsCountCharacters) {
  const JsonDocument document =
      parse_json("{\"\xC3\xA4\xC3\xB6\xE2\x82\xAC\": 1, \"b\": 2}", "f.json");
  EXPECT_EQ(place(document.key_position("/b")), "f.json:1:12");
}

TEST(ParseJson, CarriageReturnsAndByteOrderMarksDoNotShiftPlaces) {
  const JsonDocument document = parse_json("\xEF\xBB\xBF{\r\n  \"a\": 1\r\n}", "f.json");
  EXPECT_EQ(place(document.key_position("/a")), "f.json:2:3");
  EXPECT_EQ(place(document.position("")), "f.json:1:1");
}

TEST(ParseJson, ReportsAllDuplicatesAtOnce) {
  EXPECT_EQ(errors_of("{ \"a\": 1,\n  \"a\": 2,\n  \"b\": { \"c\": 1, \"c\": 2, \"c\": 3 } }"),
            "f.json:2:3: /a: duplicate key \"a\"; the first one is at 1:3\n"
            "f.json:3:18: /b/c: duplicate key \"c\"; the first one is at 3:10\n"
            "f.json:3:26: /b/c: duplicate key \"c\"; the first one is at 3:10");
}

TEST(ParseJson, DuplicatesAreComparedUnescaped) {
  EXPECT_THAT(errors_of(R"({ "a": 1, "\u0061": 2 })"), HasSubstr("f.json:1:11: /a: duplicate key"));
}

TEST(ParseJson, TheSameKeyInTwoObjectsIsNoDuplicate) {
  EXPECT_EQ(errors_of(R"([ { "a": 1 }, { "a": 2, "b": { "a": 3 } } ])"), "no error");
}

TEST(ParseJson, SyntaxErrorsHaveAPlace) {
  EXPECT_EQ(errors_of("{ \"a\": 1,\n }"),
            "f.json:2:2: syntax error while parsing object key - unexpected '}'; expected string "
            "literal");
  EXPECT_EQ(errors_of("[1, 2"),
            "f.json:1:6: syntax error while parsing array - unexpected end of "
            "input; expected ']'");
  EXPECT_THAT(errors_of("{ \"a\": tru }"),
              HasSubstr("f.json:1:8: syntax error while parsing value"));
  EXPECT_THAT(errors_of("{ \"a\": NaN }"), HasSubstr("f.json:1:8: "));
  EXPECT_THAT(errors_of("{ \"a\": 1 // no\n }"), HasSubstr("f.json:1:10: "));
  EXPECT_THAT(errors_of("{ 'a': 1 }"), HasSubstr("f.json:1:3: "));
  EXPECT_THAT(errors_of(""),
              HasSubstr("f.json:1:1: syntax error while parsing value - unexpected end"));
}

TEST(ParseJson, SyntaxErrorsAfterDuplicatesKeepBoth) {
  const std::string errors = errors_of("{ \"a\": 1, \"a\": 2, }");
  EXPECT_THAT(errors, HasSubstr("f.json:1:11: /a: duplicate key"));
  EXPECT_THAT(errors, HasSubstr("f.json:1:19: syntax error"));
}

TEST(ParseJson, RefusesWhatFollowsTheValue) {
  EXPECT_THAT(errors_of("{} {}"), HasSubstr("f.json:1:4: "));
  EXPECT_THAT(errors_of("{}\n]"), HasSubstr("f.json:2:1: "));
  EXPECT_EQ(errors_of("{}  \n\n"), "no error");
}

TEST(ParseJson, RefusesInvalidUtf8WithoutRepeatingIt) {
  const std::string errors = errors_of("{ \"a\": \"\xC3(\" }");
  EXPECT_THAT(errors, HasSubstr("f.json:1:8: "));
  EXPECT_THAT(errors, HasSubstr("UTF-8"));
  EXPECT_EQ(errors.find('\xC3'), std::string::npos);
}

TEST(ParseJson, RefusesNumbersBeyondADouble) {
  EXPECT_EQ(errors_of("[ 1e400 ]"), "f.json:1:3: number 1e400 is too large");
  EXPECT_EQ(errors_of("[ 1e300 ]"), "no error");
}

TEST(ParseJson, NestsSixtyFourLevelsAndNoMore) {
  EXPECT_EQ(errors_of(std::string(64, '[') + std::string(64, ']')), "no error");
  EXPECT_THAT(errors_of(std::string(65, '[') + std::string(65, ']')), HasSubstr("f.json:1:65: "));
  EXPECT_THAT(errors_of(std::string(1000000, '[')), HasSubstr("nested deeper than 64 levels"));
}

TEST(ParseJson, RefusesEndlessKeys) {
  EXPECT_THAT(errors_of("{ \"" + std::string(1025, 'k') + "\": 1 }"),
              HasSubstr("f.json:1:3: key is longer than 1024 bytes"));
  EXPECT_EQ(errors_of("{ \"" + std::string(1024, 'k') + "\": 1 }"), "no error");
}

TEST(Pointers, EscapeAndBack) {
  EXPECT_EQ(pointer_token("a/b~c"), "a~1b~0c");
  EXPECT_THAT(pointer_tokens("/a~1b~0c/0//~01"), testing::ElementsAre("a/b~c", "0", "", "~1"));
  EXPECT_THAT(pointer_tokens(""), testing::IsEmpty());
}

class ReadJson : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("read_json" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string error(const std::filesystem::path& file) const {
    try {
      read_json(file);
    } catch (const UserError& e) {
      return e.what();
    }
    return "no error";
  }
  std::filesystem::path folder_;
};

TEST_F(ReadJson, ReadsAFile) {
  std::ofstream(folder_ / "a.json") << "{ \"x\": [1] }";
  const JsonDocument document = read_json(folder_ / "a.json");
  EXPECT_EQ(document.root["x"][0], 1);
  EXPECT_EQ(document.file, (folder_ / "a.json").string());
}

TEST_F(ReadJson, NamesTheFileInEveryError) {
  EXPECT_EQ(error(folder_ / "none.json"), (folder_ / "none.json").string() + ": no such file");
  EXPECT_EQ(error(folder_), folder_.string() + ": is a folder, expected a JSON file");
  EXPECT_EQ(error("/dev/null"), "/dev/null: is not a regular file");
}

TEST_F(ReadJson, RefusesHugeFiles) {
  const std::filesystem::path file = folder_ / "huge.json";
  std::ofstream(file) << "{}";
  std::filesystem::resize_file(file, kMaxJsonFileBytes + 1);  // sparse
  EXPECT_THAT(error(file), HasSubstr("has 67108865 bytes, more than the 67108864"));
}

}  // namespace
}  // namespace plaza
