#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/config/pipeline.h"
#include "framework/plugin/registry.h"
#include "plaza/component/declaration.h"
#include "plaza/geometry/scene.h"
#include "tests/support/temporary_folder.h"

namespace plaza::test {

/// Components that do little, visibly, and fail on demand: "test-source", "test-detector",
/// "test-describer", "test-learner", "test-associator", "test-scores", "test-sink",
/// "test-renderer". All take `fail_in` (a phase), `fail_at` (a frame from 0) and `error` (user,
/// internal, foreign, alien, full, crash).
void register_doubles(ComponentRegistrar& registrar);

/// A registry with the doubles.
Registry double_registry();

/// What the doubles did in this process.
struct Counters {
  std::atomic<std::int64_t> reads{0};
  std::atomic<std::int64_t> learned_frames{0};
  std::atomic<std::int64_t> learned_models{0};
  std::atomic<std::int64_t> loaded_models{0};
};
Counters& counters();

/// Two small views of one place, 25 frames per second.
std::shared_ptr<const Scene> double_scene();

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
std::vector<std::string> lines_of(const std::filesystem::path& file);

/// All files below a folder by relative path, with their content.
std::map<std::string, std::string> contents_of(const std::filesystem::path& folder);

}  // namespace plaza::test
