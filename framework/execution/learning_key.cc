#include "framework/execution/learning_key.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "framework/execution/guard.h"
#include "framework/execution/model_cache.h"
#include "plaza/component/learner.h"
#include "plaza/version.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::streamsize kSampleBytes = 64 * 1024;

std::string sample(std::ifstream& in, std::streamoff offset) {
  std::string bytes(static_cast<std::size_t>(kSampleBytes), '\0');
  in.clear();
  in.seekg(offset);
  in.read(bytes.data(), kSampleBytes);
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// A plugin's code, all of it: another build of the same plugin may learn something else.
std::string library_identity(const fs::path& library) {
  if (library.empty()) return "built in";
  std::ifstream in(library, std::ios::binary);
  Hash hash;
  std::string block(static_cast<std::size_t>(kSampleBytes), '\0');
  while (in.read(block.data(), kSampleBytes), in.gcount() > 0) {
    hash.add(std::string_view(block).substr(0, static_cast<std::size_t>(in.gcount())));
  }
  return hash.text();
}

void add_files(const ParameterSpec& spec, const json& value, json& files) {
  if (value.is_null()) return;
  if (spec.type == ParameterType::kPath && value.is_string()) {
    files[value.get<std::string>()] = file_identity(value.get<std::string>());
  } else if ((spec.type == ParameterType::kList || spec.type == ParameterType::kMap) &&
             !spec.element.empty()) {
    for (const json& element : value) add_files(spec.element[0], element, files);
  }
}

json key_of(const ResolvedPart& part, std::map<fs::path, std::string>& libraries) {
  const ComponentEntry& entry = *part.entry;
  if (!libraries.contains(entry.library)) {
    libraries[entry.library] = library_identity(entry.library);
  }
  json files = json::object();
  for (const ParameterSpec& spec : entry.declaration.parameters) {
    if (const auto it = part.values.find(spec.name); it != part.values.end()) {
      add_files(spec, *it, files);
    }
  }
  json key = {{"name", part.name},
              {"use", entry.declaration.name},
              {"library", libraries[entry.library]},
              {"values", part.values}};
  if (!files.empty()) key["files"] = std::move(files);
  for (const auto& [parameter, parts] : part.parts) {
    for (const ResolvedPart& nested : parts)
      key["parts"][parameter].push_back(key_of(nested, libraries));
  }
  return key;
}

void collect_above(const ExecutionPlan& plan, std::size_t index, std::set<std::size_t>& nodes) {
  if (!nodes.insert(index).second) return;
  for (const Wire& wire : plan.nodes[index].resolved->inputs) {
    if (wire.node >= 0) collect_above(plan, static_cast<std::size_t>(wire.node), nodes);
  }
}

}  // namespace

std::string file_identity(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) {
    std::vector<std::string> entries;
    for (const auto& entry : fs::directory_iterator(file, error)) {
      std::error_code gone;
      const auto size = entry.is_regular_file(gone) ? entry.file_size(gone) : 0;
      const auto time = entry.last_write_time(gone).time_since_epoch().count();
      entries.push_back(entry.path().filename().string() + ":" + std::to_string(size) + ":" +
                        std::to_string(time));
    }
    std::sort(entries.begin(), entries.end());
    Hash hash;
    for (const std::string& entry : entries) hash.add(entry + "\n");
    return "folder:" + hash.text();
  }
  if (!fs::is_regular_file(status)) return "absent";
  const auto size = fs::file_size(file, error);
  const auto time = fs::last_write_time(file, error).time_since_epoch().count();
  std::ifstream in(file, std::ios::binary);
  Hash hash;
  hash.add(sample(in, 0));
  if (size > static_cast<std::uintmax_t>(kSampleBytes)) {
    hash.add(sample(in, static_cast<std::streamoff>(size) - kSampleBytes));
  }
  return std::to_string(size) + ":" + std::to_string(time) + ":" + hash.text();
}

std::string scene_fingerprint(const Scene& scene) {
  json key = {
      {"area",
       {scene.area.min_m.x(), scene.area.min_m.y(), scene.area.max_m.x(), scene.area.max_m.y()}},
      {"frame_rate_hz", scene.frame_rate_hz},
      {"body", {scene.body.height_m, scene.body.radius_m}}};
  for (const Camera& camera : scene.cameras) {
    key["cameras"].push_back({camera.name(), camera.fingerprint()});
  }
  for (const StaticOccluder& occluder : scene.occluders) {
    json polygon = json::array();
    for (const Eigen::Vector2d& p : occluder.polygon_px) polygon.push_back({p.x(), p.y()});
    key["occluders"].push_back({occluder.camera, std::move(polygon)});
  }
  return key.dump();
}

std::string learning_key(const ExecutionPlan& plan, std::size_t index,
                         const ResolvedPipeline& pipeline, const Scene& scene) {
  std::set<std::size_t> nodes;
  collect_above(plan, index, nodes);
  nodes.insert(plan.clock);  // the learner sees its frames whether or not it reads them later
  json key = {{"plaza", PLAZA_VERSION},
              {"seed", pipeline.seed},
              {"scene", scene_fingerprint(scene)},
              {"learner", plan.nodes[index].name}};
  std::map<fs::path, std::string> libraries;
  for (const std::size_t i : nodes) {
    const PlannedNode& node = plan.nodes[i];
    json part = key_of(*node.resolved, libraries);
    if (node.source != nullptr) {
      part["content"] =
          guarded(node.name, std::nullopt, [&] { return node.source->content_key(); });
    }
    for (const Wire& wire : node.resolved->inputs)
      part["inputs"].push_back({wire.node, wire.output});
    for (const auto& [parameter, records] : node.resolved->input_lists) {
      for (const ResolvedInputRecord& record : records) {
        part["input_lists"][parameter].push_back({record.from, record.fields});
      }
    }
    key["nodes"].push_back(std::move(part));
  }
  key["extra"] = guarded(plan.nodes[index].name, std::nullopt,
                         [&] { return plan.nodes[index].node->learner()->extra_key(); });
  // content_key() and extra_key() may hold any bytes
  return key.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace plaza
