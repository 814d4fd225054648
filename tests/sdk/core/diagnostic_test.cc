#include "plaza/core/diagnostic.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace plaza {
namespace {

Diagnostic make(std::string file, int line, int column, std::string pointer, std::string message) {
  Diagnostic d;
  d.where = {std::move(file), line, column};
  d.pointer = std::move(pointer);
  d.message = std::move(message);
  return d;
}

TEST(DiagnosticTest, AFaultOfAValueHasNoFileYet) {
  EXPECT_EQ(fault_at("/sizes/1", "must be positive"),
            make("", 0, 0, "/sizes/1", "must be positive"));
  EXPECT_EQ(to_string(fault_at("/sizes/1", "must be positive")), "/sizes/1: must be positive");
}

TEST(DiagnosticTest, NamesPlacePointerAndMessage) {
  EXPECT_EQ(to_string(make("p.json", 12, 7, "/nodes/1/sigma_pxx", "unknown parameter")),
            "p.json:12:7: /nodes/1/sigma_pxx: unknown parameter");
}

TEST(DiagnosticTest, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string(make("gt.txt", 3, 0, "", "six fields")), "gt.txt:3: six fields");
  EXPECT_EQ(to_string(make("gt.txt", 0, 4, "", "empty")), "gt.txt: empty")
      << "a column without its line says nothing";
  EXPECT_EQ(to_string(make("", 0, 0, "/seed", "negative")), "/seed: negative");
  EXPECT_EQ(to_string(make("", 0, 0, "", "no plugin")), "no plugin");
}

TEST(DiagnosticTest, ListsOneALineInOrder) {
  EXPECT_EQ(to_string(Diagnostics{}), "");
  EXPECT_EQ(to_string(Diagnostics{make("b", 2, 1, "", "second"), make("a", 1, 1, "", "first")}),
            "b:2:1: second\na:1:1: first");
}

}  // namespace
}  // namespace plaza
