// Whatever stands in a Tsai calibration, reading it ends with finite numbers or with a UserError
// whose every diagnostic has a place and a message; a camera made of it never fails otherwise,
// either.
#include "framework/scene/calibration.h"
#include "tests/fuzz/calibration_oracle.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  plaza::fuzz::try_calibration([&] { return plaza::parse_tsai_xml(text, "fuzzed.xml"); });
  return 0;
}
