#include "framework/cache/component_key.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "framework/config/resolved_values.h"
#include "framework/execution/guard.h"
#include "framework/execution/model_cache.h"

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

std::string hash_of_library(const fs::path& library) {
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

const std::string& LibraryIdentities::of(const fs::path& library) {
  const auto known = known_.find(library);
  if (known != known_.end()) return known->second;
  return known_.emplace(library, hash_of_library(library)).first->second;
}

json component_key(const ResolvedPart& part, LibraryIdentities& libraries) {
  const ComponentEntry& entry = *part.entry;
  json files = json::object();
  json values = json::object();
  for (const ParameterSpec& spec : entry.declaration.parameters) {
    const auto it = part.values.find(spec.name);
    if (it == part.values.end()) continue;
    values[spec.name] = with_absolute_paths(*it, spec);
    add_files(spec, values[spec.name], files);
  }
  json key = {{"name", part.name},
              {"use", entry.declaration.name},
              {"library", libraries.of(entry.library)},
              {"values", std::move(values)}};
  if (!files.empty()) key["files"] = std::move(files);
  for (const auto& [parameter, parts] : part.parts) {
    for (const ResolvedPart& nested : parts)
      key["parts"][parameter].push_back(component_key(nested, libraries));
  }
  return key;
}

json node_key(const ExecutionPlan& plan, std::size_t index, LibraryIdentities& libraries) {
  const PlannedNode& node = plan.nodes[index];
  json key = component_key(*node.resolved, libraries);
  if (node.source != nullptr) {
    key["content"] = guarded(node.name, std::nullopt, [&] { return node.source->content_key(); });
    key["clock"] = index == plan.clock;
  }
  for (const Wire& wire : node.resolved->inputs) {
    // by name: nodes that have nothing to do with this one may come and go between the two
    const json from =
        wire.node < 0 ? json() : json(plan.nodes[static_cast<std::size_t>(wire.node)].name);
    key["inputs"].push_back({from, wire.output});
  }
  for (const auto& [parameter, records] : node.resolved->input_lists) {
    for (const ResolvedInputRecord& record : records) {
      key["input_lists"][parameter].push_back({record.from, record.fields});
    }
  }
  return key;
}

std::set<std::size_t> nodes_above(const ExecutionPlan& plan, std::size_t index) {
  std::set<std::size_t> nodes;
  std::set<std::size_t> open = {index};
  while (!open.empty()) {
    const std::size_t n = *open.rbegin();  // wires lead upwards, so nothing is seen twice
    open.erase(n);
    nodes.insert(n);
    for (const Wire& wire : plan.nodes[n].resolved->inputs) {
      if (wire.node >= 0) open.insert(static_cast<std::size_t>(wire.node));
    }
  }
  return nodes;
}

}  // namespace plaza
