// Whatever a pipeline says, reading it ends with a pipeline or with a UserError whose every
// diagnostic has a message; never with another exception, a crash or endless work.
//
// The first line may hold a --set option; the rest is the pipeline.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "framework/config/json_document.h"
#include "framework/config/pipeline.h"
#include "plaza/core/error.h"
#include "tests/fuzz/require.h"
#include "tests/support/test_components.h"

namespace {

using plaza::fuzz::require;

void check(const plaza::UserError& error) {
  for (const plaza::Diagnostic& diagnostic : error.diagnostics()) {
    require(!diagnostic.message.empty(), "diagnostic without a message");
    require(!diagnostic.where.file.empty(), "diagnostic without a place");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plaza::Registry registry = plaza::test::make_registry();
  std::string_view text(reinterpret_cast<const char*>(data), size);
  plaza::PipelineRequest request;
  // beside the broken pipelines, where there is a scene and something to extend
  request.file = PLAZA_SOURCE_DIR "/tests/error/pipelines/fuzzed.json";
  if (text.starts_with('/')) {
    const std::string_view line = text.substr(0, text.find('\n'));
    request.sets.emplace_back(line);
    text.remove_prefix(line.size());
  }
  try {
    plaza::parse_json(text, request.file.string());
  } catch (const plaza::UserError& error) {
    check(error);
  }
  try {
    plaza::read_pipeline_text(text, request, registry).resolved_json();
  } catch (const plaza::UserError& error) {
    check(error);
  }
  return 0;
}
