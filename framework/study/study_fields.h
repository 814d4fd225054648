#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/config_value.h"
#include "framework/study/study.h"

namespace plaza {

/// Reads the pieces that a study file is made of; what is wrong goes to the sink, and what is
/// returned then is of no use.
class StudyFields {
 public:
  StudyFields(std::filesystem::path file, DiagnosticSink& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  void fail(const Origin& origin, std::string message) {
    diagnostics_.add(origin, std::move(message));
  }

  /// Keys that `object`, a `what`, does not have are faults.
  void know(const ConfigValue& object, const std::vector<std::string>& keys,
            const std::string& what);
  /// The text of member `key`; empty when there is none or it is no text.
  std::string text(const ConfigValue& object, const std::string& key);
  /// True when `value` is a list of at least one item, called `what` in messages.
  bool is_filled_list(const ConfigValue& value, const std::string& what);
  /// Words of a list, or one word for a list of it.
  std::vector<std::string> words(const ConfigValue& value, const std::string& what);

  std::optional<std::filesystem::path> path(const ConfigValue& value);
  std::optional<FrameRange> frames(const ConfigValue& value);
  /// Whole numbers from 0, all different.
  std::vector<std::uint64_t> seeds(const ConfigValue& value);
  bool pointer(const ConfigValue& value);

  /// Members "pipeline", "scene", "frames", "set", "nodes" of `object`.
  Change change(const ConfigValue& object);
  static const std::vector<std::string>& change_keys();

 private:
  std::filesystem::path file_;
  DiagnosticSink& diagnostics_;
};

/// A word for a value on an axis: 0.5, edges, location+appearance, 0:400, sigma_m=2; empty where it
/// has none.
std::string label_of(const ConfigValue& value);

}  // namespace plaza
