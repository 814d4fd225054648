// `plaza run --progress json`: lines that other programs read, from the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/error/runs/program_run.h"

namespace plaza::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

bool is_text(const json& value) { return value.is_string() && value != ""; }
bool is_truth(const json& value) { return value.is_boolean(); }
bool is_count(const json& value) { return value.is_number_integer() && value >= 0; }
bool is_amount(const json& value) { return value.is_number() && value >= 0; }
bool is_phase(const json& value) {
  return value == "learn" || value == "stream" || value == "render";
}
bool is_artifacts(const json& value) {
  if (!value.is_array()) return false;
  return std::ranges::all_of(value, [](const json& item) {
    return item.is_object() && item.size() == 2 && is_text(item.value("file", json())) &&
           is_text(item.value("what", json()));
  });
}

struct Field {
  std::string name;
  bool (*fits)(const json& value);
  bool required = true;
};

/// The line's schema: what each event holds.
const std::map<std::string, std::vector<Field>> kEvents = {{"progress",
                                                            {{"event", is_text},
                                                             {"phase", is_phase},
                                                             {"done", is_count},
                                                             {"total", is_count, false},
                                                             {"frames_per_second", is_amount},
                                                             {"remaining_s", is_amount, false}}},
                                                           {"end",
                                                            {{"event", is_text},
                                                             {"complete", is_truth},
                                                             {"frames", is_count},
                                                             {"seconds", is_amount},
                                                             {"out", is_text},
                                                             {"artifacts", is_artifacts},
                                                             {"reason", is_text, false}}}};

/// What is wrong with a line; empty: nothing.
std::string fault_of(const std::string& text) {
  const json line = json::parse(text, nullptr, false);
  if (!line.is_object()) return "no JSON object";
  const json event = line.value("event", json());
  const auto fields = kEvents.find(event.is_string() ? event.get<std::string>() : "");
  if (fields == kEvents.end()) return "unknown event " + event.dump();
  std::size_t known = 0;
  for (const Field& field : fields->second) {
    const auto value = line.find(field.name);
    if (value == line.end()) {
      if (field.required) return "lacks " + field.name;
      continue;
    }
    if (!field.fits(*value)) return "wrong " + field.name + ": " + value->dump();
    ++known;
  }
  return known == line.size() ? "" : "holds what no reader knows";
}

TEST(ProgressLineSchema, FindsEachKindOfFault) {
  const std::string good = R"({"event":"progress","phase":"learn","done":3,"frames_per_second":2})";
  EXPECT_EQ(fault_of(good), "");
  EXPECT_EQ(fault_of(good.substr(1)), "no JSON object");
  EXPECT_EQ(fault_of(R"({"event":"tick"})"), "unknown event \"tick\"");
  EXPECT_EQ(fault_of(R"({"event":"progress","phase":"learn","done":3})"),
            "lacks frames_per_second");
  EXPECT_EQ(fault_of(R"({"event":"progress","phase":"nap"})"), "wrong phase: \"nap\"");
  EXPECT_EQ(fault_of(R"({"event":"progress","phase":"learn","done":-1})"), "wrong done: -1");
  EXPECT_EQ(fault_of(good.substr(0, good.size() - 1) + R"(,"mood":1})"),
            "holds what no reader knows");
}

class ProgressJson : public ProgramRun {
 protected:
  /// Runs the pipeline with these options; the lines of its stdout, each of which follows the
  /// schema.
  std::vector<json> run(const std::vector<std::string>& options, int expected_status = 0) {
    std::string words = "XDG_CACHE_HOME='" + (folder_ / "cache").string() + "' ";
    for (const std::string& word : command(folder_ / "out", 2, options)) words += "'" + word + "' ";
    const int status = std::system(
        (words + "> '" + (folder_ / "out.txt").string() + "' 2> '" + errors_.string() + "'")
            .c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == expected_status) << read_text(errors_);
    std::vector<json> lines;
    for (const std::string& line : lines_of(folder_ / "out.txt")) {
      EXPECT_EQ(fault_of(line), "") << line;
      lines.push_back(json::parse(line));
    }
    return lines;
  }

  const std::filesystem::path errors_ = folder_ / "errors.txt";
};

TEST_F(ProgressJson, TellsHowFarEachPhaseIsAndHowItEnded) {
  // slow enough that a phase has more than its last line
  write_pipeline(60, 20000,
                 {{{"use", "test-learner"}, {"name", "background"}, {"first", 20}},
                  {{"use", "test-renderer"}, {"name", "overlay"}}});
  const std::vector<json> lines = run({"--progress", "json"});
  EXPECT_THAT(read_text(errors_), StartsWith("plaza: note: node 'cameras', camera 'right'"))
      << "notes are for people";

  ASSERT_FALSE(lines.empty());
  const json& end = lines.back();
  EXPECT_EQ(end["event"], "end");
  EXPECT_EQ(end["complete"], true);
  EXPECT_EQ(end["frames"], 60);
  EXPECT_FALSE(end.contains("reason"));
  for (const json& artifact : end["artifacts"]) {
    EXPECT_TRUE(std::filesystem::exists(artifact["file"].get<std::string>())) << artifact;
  }

  std::vector<std::string> phases;
  std::map<std::string, std::vector<json>> by_phase;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const json& line = lines[i];
    ASSERT_EQ(line["event"], "progress") << "only the last line is the end";
    if (phases.empty() || phases.back() != line["phase"]) phases.push_back(line["phase"]);
    std::vector<json>& before = by_phase[phases.back()];
    if (!before.empty()) {
      EXPECT_GE(line["done"], before.back()["done"]);
      EXPECT_EQ(line["total"], before.back()["total"]);
    }
    before.push_back(line);
  }
  EXPECT_THAT(phases, ElementsAre("learn", "stream", "render"));
  EXPECT_GT(by_phase["stream"].size(), 1U);
  EXPECT_EQ(by_phase["learn"].back()["done"], 20);
  for (const char* phase : {"stream", "render"}) {
    const json& last = by_phase[phase].back();
    EXPECT_EQ(last["done"], 60) << phase;
    EXPECT_EQ(last["total"], 60) << phase;
    EXPECT_EQ(last["remaining_s"], 0) << phase;
  }
}

TEST_F(ProgressJson, PromisesNothingWhereTheEndIsNotKnown) {
  write_pipeline(30, 1000);
  const auto lines = run({"--progress", "json", "--set", "/nodes/cameras/announce=false"});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["done"], 30);
  EXPECT_FALSE(lines[0].contains("total"));
  EXPECT_FALSE(lines[0].contains("remaining_s"));
}

TEST_F(ProgressJson, AFaultStandsOnStderrAndItsFramesInTheLines) {
  write_pipeline(30, 0);
  const auto lines = run({"--progress", "json", "--set", "/nodes/detector/fail_in=process", "--set",
                          "/nodes/detector/fail_at=12"},
                         2);
  for (const json& line : lines) EXPECT_EQ(line["event"], "progress") << "no end was reached";
  EXPECT_THAT(read_text(errors_), HasSubstr("plaza: node 'detector', frame 13: asked to fail"));
}

TEST_F(ProgressJson, IsSilencedByQuiet) {
  write_pipeline(5, 0);
  EXPECT_THAT(run({"--progress", "json", "--quiet"}), IsEmpty());
}

}  // namespace
}  // namespace plaza::test
