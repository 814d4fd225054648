#include "framework/study/job_result.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "framework/execution/model_cache.h"
#include "plaza/io/output_file.h"

namespace plaza {
namespace {

using nlohmann::json;

constexpr int kLayout = 2;

std::string hash_text(std::string_view text) {
  Hash hash;
  hash.add(text);
  return hash.text();
}

}  // namespace

std::optional<JobResult> read_job_result(const std::filesystem::path& folder,
                                         std::string_view key) {
  std::ifstream in(folder / "result.json", std::ios::binary);
  if (!in) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const json file = json::parse(text, nullptr, false);
  if (!file.is_object() || file.value("layout", 0) != kLayout || file.value("key", "") != key) {
    return std::nullopt;
  }
  try {
    const json& content = file.at("result");
    if (file.at("checksum") != hash_text(content.dump())) return std::nullopt;
    JobResult result;
    result.error = content.at("error").get<std::string>();
    result.again = content.at("again").get<bool>();
    result.frames = content.at("frames").get<std::int64_t>();
    result.node_seconds = content.at("node_seconds").get<double>();
    result.evaluation = content.at("evaluation").get<Evaluation>();
    result.branches = content.at("branches").get<std::map<std::string, Evaluation>>();
    return result;
  } catch (const json::exception&) {
    return std::nullopt;  // somebody's own work; the job is run again
  }
}

void write_job_result(const std::filesystem::path& folder, std::string_view key,
                      const JobResult& result) {
  const json content = {{"error", result.error},           {"again", result.again},
                        {"frames", result.frames},         {"node_seconds", result.node_seconds},
                        {"evaluation", result.evaluation}, {"branches", result.branches}};
  // a plugin's message in "error" may be in any encoding
  const auto dump = [](const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
  };
  const json clean = json::parse(dump(content));
  write_file(folder / "result.json", dump({{"layout", kLayout},
                                           {"key", key},
                                           {"checksum", hash_text(clean.dump())},
                                           {"result", clean}}) +
                                         "\n");
}

}  // namespace plaza
