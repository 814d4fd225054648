// The same promise for calibrations in OpenCV's YAML, XML and JSON, in R/T/K JSON and Tsai's JSON,
// and for whole scenes. The first byte chooses the reader.
#include "framework/scene/scene_file.h"
#include "tests/fuzz/calibration_oracle.h"

namespace {

void try_scene(std::string_view text) {
  try {
    const auto scene = plaza::parse_scene(
        plaza::parse_json(text, PLAZA_SOURCE_DIR "/tests/error/scenes/fuzzed.json"));
    plaza::fuzz::require(!scene->cameras.empty(), "scene without cameras");
  } catch (const plaza::UserError& error) {
    for (const plaza::Diagnostic& d : error.diagnostics()) {
      plaza::fuzz::require(!d.message.empty(), "diagnostic without a message");
      plaza::fuzz::require(!d.where.file.empty(), "diagnostic without a place");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  using plaza::fuzz::try_calibration;
  switch (data[0]) {
    case 's':
      try_scene(text);
      break;
    case 'r':
      try_calibration([&] {
        return plaza::parse_rtk_json(text, "fuzzed", "0", plaza::TranslationMeaning::kCentre);
      });
      break;
    case 't':
      try_calibration([&] { return plaza::parse_tsai_json(text, "fuzzed", 0); });
      break;
    default:
      try_calibration([&] { return plaza::parse_opencv({std::string(text), "fuzzed"}, nullptr); });
  }
  return 0;
}
