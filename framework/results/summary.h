#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plaza/component/evaluator.h"

namespace plaza {

struct NodeTiming {
  std::string name;
  std::string use;
  std::int64_t calls = 0;
  double seconds = 0;
};

/// The content of summary.json.
struct Summary {
  std::string pipeline;
  bool complete = false;
  std::string reason;  ///< why it is not complete
  std::int64_t frames = 0;
  std::size_t cameras = 0;
  double seconds = 0;
  std::vector<NodeTiming> nodes;
  Evaluation evaluation;                       ///< of the main branch
  std::map<std::string, Evaluation> branches;  ///< of the others, by node
};

/// Keys as in the contract; "reason" only when the run is not complete.
nlohmann::ordered_json summary_json(const Summary& summary);

/// Writes summary.json atomically.
void write_summary(const std::filesystem::path& folder, const Summary& summary);

}  // namespace plaza
