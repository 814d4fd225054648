#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "plaza/core/diagnostic.h"
#include "plaza/core/export.h"

namespace plaza {

/// Where in a run a fault happened. Filled in by the guard around every plugin call.
struct FaultContext {
  std::string component;              ///< node or part name, e.g. "detector"
  std::optional<std::int64_t> frame;  ///< from 0
  std::string camera;                 ///< empty when the fault belongs to no single view

  bool operator==(const FaultContext&) const = default;
};

/// Common base of Plaza's exceptions; what() is a complete sentence or list of diagnostics.
class PLAZA_API Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  ~Error() override;  // key function: one copy of the type information, in the SDK library

  const FaultContext& context() const noexcept { return context_; }
  /// Adds what the thrower did not know; what is already known is kept (the innermost place wins).
  void add_context(const FaultContext& outer);

 private:
  FaultContext context_;
};

/// The user's mistake: configuration, files, calibration, plugins. Exit status 2, no stack.
class PLAZA_API UserError : public Error {
 public:
  explicit UserError(const std::string& message);
  explicit UserError(Diagnostic diagnostic);
  explicit UserError(Diagnostics diagnostics);  ///< throws std::invalid_argument when empty
  ~UserError() override;

  const Diagnostics& diagnostics() const noexcept { return diagnostics_; }

 private:
  Diagnostics diagnostics_;
};

/// Our mistake, or a plugin's: a broken invariant. Exit status 3.
class PLAZA_API InternalError : public Error {
 public:
  explicit InternalError(const std::string& message) : Error(message) {}
  ~InternalError() override;
};

/// "node 'detector', frame 12, camera 'view1'", leaving out what is not known; frames as in files,
/// from 1.
PLAZA_API std::string to_string(const FaultContext& context);

}  // namespace plaza
