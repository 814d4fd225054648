#include "tests/error/runs/program_run.h"

#include <algorithm>

#include "tests/support/execution_fixture.h"

namespace plaza::test {

namespace fs = std::filesystem;
using nlohmann::json;

void ProgramRun::SetUp() {
  const auto camera = [](const std::string& name, double x_m) {
    return json{{"name", name},
                {"image_size", {64, 48}},
                {"calibration",
                 {{"format", "pinhole"},
                  {"fx_px", 50},
                  {"fy_px", 50},
                  {"cx_px", 31.5},
                  {"cy_px", 23.5},
                  {"centre_m", {x_m, -8, 2.5}},
                  {"look_at_m", {0, -3, 1.2}}}}};
  };
  const json scene = {{"plaza_scene", 1},
                      {"name", "Two views"},
                      {"frame_rate_hz", 25},
                      {"area", {{"x_m", {-4, 4}}, {"y_m", {-3, 3}}}},
                      {"cameras", {camera("left", -1), camera("right", 1)}}};
  write_text(folder_ / "scene.json", scene.dump(2));
}

void ProgramRun::write_pipeline(std::int64_t frames, std::int64_t delay_us, const json& more) {
  json nodes = plain_nodes();
  nodes[0]["frames"] = frames;
  nodes[0]["delay_us"] = delay_us;
  for (const json& node : more) nodes.push_back(node);
  const json pipeline = {{"plaza", 1}, {"name", "Test"}, {"scene", "scene.json"}, {"nodes", nodes}};
  write_text(folder_ / "pipeline.json", pipeline.dump(2));
}

std::vector<std::string> ProgramRun::command(const fs::path& out, int threads,
                                             const std::vector<std::string>& options) const {
  std::vector<std::string> words = {
      PLAZA_PROGRAM,   "run",         (folder_ / "pipeline.json").string(),
      "--plugin-path", PLAZA_DOUBLES, "--out",
      out.string(),    "--threads",   std::to_string(threads)};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

json ProgramRun::summary(const fs::path& out) {
  return json::parse(read_text(out / "summary.json"));
}

void ProgramRun::expect_valid(const fs::path& out) {
  if (!fs::exists(out)) return;  // ended before the check was over
  const bool complete = fs::exists(out / "summary.json") && summary(out).at("complete");
  for (const auto& [name, content] : contents_of(out)) {
    EXPECT_TRUE(!complete || !name.ends_with(".part")) << name;
    EXPECT_TRUE(!name.ends_with(".json") || json::accept(content)) << name;
    const bool rows = name.find(".csv") != std::string::npos || name.starts_with("tracks.");
    if (!rows) continue;
    EXPECT_TRUE(content.empty() || content.back() == '\n') << name << " ends within a row";
    const auto lines = lines_of(out / name);
    for (const std::string& line : lines) {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                std::count(lines[0].begin(), lines[0].end(), ','))
          << name << ": " << line;
    }
  }
}

}  // namespace plaza::test
