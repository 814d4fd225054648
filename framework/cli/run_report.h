#pragma once

#include <filesystem>
#include <iosfwd>

#include "framework/execution/run.h"

namespace plaza {

/// For people: how it went, the figures by section (not the details among them), and where to look.
void print_report(std::ostream& out, const RunReport& report, const ResolvedPipeline& pipeline,
                  const std::filesystem::path& folder);

/// The last of the JSON lines: {"event":"end","complete":...,"frames":...,"seconds":...,"out":...,
/// "artifacts":[{"file":...,"what":...}]}.
void print_report_json(std::ostream& out, const RunReport& report,
                       const std::filesystem::path& folder);

}  // namespace plaza
