#pragma once

#include <string>
#include <vector>

#include "plaza/core/export.h"

namespace plaza {

/// A place in a text file. Lines and columns count from 1; 0 means "not known".
struct FilePosition {
  std::string file;
  int line = 0;
  int column = 0;

  bool operator==(const FilePosition&) const = default;
};

/// One fault found in what the user gave us.
struct Diagnostic {
  FilePosition where;
  std::string pointer;  ///< JSON pointer of the value ("/nodes/1/sigma_px"), empty outside JSON
  std::string message;  ///< what is wrong and what would be right

  bool operator==(const Diagnostic&) const = default;
};

using Diagnostics = std::vector<Diagnostic>;

/// A fault of the value at `pointer`, a parameter of a component ("/model") or a value in one
/// ("/sizes/1"); whoever reads the file adds where that is.
PLAZA_API Diagnostic fault_at(std::string pointer, std::string message);

/// "pipeline.json:12:7: /nodes/1/sigma_pxx: unknown parameter ...", leaving out what is not known.
PLAZA_API std::string to_string(const Diagnostic& diagnostic);

/// One line per diagnostic, in the order given, without a trailing newline.
PLAZA_API std::string to_string(const Diagnostics& diagnostics);

}  // namespace plaza
