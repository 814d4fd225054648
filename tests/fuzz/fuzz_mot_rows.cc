// Rows of any bytes: the readers either give rows that keep their promises, or a UserError; and
// what they give can be scored.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "plaza/core/error.h"
#include "plaza/io/mot_rows.h"
#include "plaza/scoring/mot_challenge.h"
#include "plaza/scoring/sections.h"

namespace {

constexpr std::size_t kScoredRows = 64;  // scoring is cubic, fuzzing wants to be fast

void require(bool condition) {
  if (!condition) std::abort();
}

bool all_finite(const nlohmann::json& section) {
  for (const auto& [key, value] : section.items()) {
    if (value.is_number_float() && !std::isfinite(value.get<double>())) return false;
  }
  return true;
}

void score_boxes(const std::vector<plaza::MotRow>& truth, const std::vector<plaza::MotRow>& result,
                 plaza::MotRules rules) {
  const plaza::PairedSequence s = plaza::pair_mot_rows({"gt", truth}, {"result", result}, rules);
  require(all_finite(plaza::image_tracking_section(s, 0.5)));
  require(all_finite(plaza::image_detection_section(s, 0.5)));
  require(all_finite(plaza::thesis_section(&s, &s, 0.3)));
}

template <class F>
void with_user_errors(const F& body) {
  try {
    body();
  } catch (const plaza::UserError& error) {
    require(!error.diagnostics().empty());
  }
}

}  // namespace

/// The first byte chooses the rules, the first 0xFF byte divides truth from result.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t divider = text.find('\xFF');
  const std::string_view first = text.substr(0, divider);
  const std::string_view second =
      divider == std::string_view::npos ? first : text.substr(divider + 1);
  const auto rules = static_cast<plaza::MotRules>(data[0] % 4);

  with_user_errors([&] {
    const auto truth = plaza::parse_mot_rows(first, "gt");
    for (const plaza::MotRow& row : truth) {
      require(row.frame >= 1 && row.box.width >= 0 && row.box.height >= 0 && row.line >= 1);
    }
    const auto result = plaza::parse_mot_rows(second, "result");
    if (truth.size() + result.size() <= kScoredRows) score_boxes(truth, result, rules);
  });
  with_user_errors([&] {
    const plaza::RowLimits limits{
        .first_frame = 0, .last_frame = 1000000, .unidentified = data[0] % 2 == 0};
    const auto truth = plaza::parse_ground_rows(first, "gt", limits, 0.025);
    for (const plaza::GroundRow& row : truth)
      require(row.position_m.allFinite() && row.frame <= 1000000);
    const auto result = plaza::parse_ground_rows(second, "result", limits);
    if (truth.size() + result.size() > kScoredRows) return;
    const plaza::PairedSequence near =
        plaza::pair_ground_rows(truth, result, /*has_identities=*/false);
    require(all_finite(plaza::ground_detection_section(near, 0.5)));
    const plaza::PairedSequence anonymous =
        plaza::pair_ground_rows(truth, result, /*has_identities=*/false, 1.0);
    require(all_finite(plaza::ground_tracking_figures(anonymous, 1.0)));
  });
  return 0;
}
