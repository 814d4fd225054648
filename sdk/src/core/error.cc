#include "plaza/core/error.h"

#include <utility>

namespace plaza {

Error::~Error() = default;
UserError::~UserError() = default;
InternalError::~InternalError() = default;

void Error::add_context(const FaultContext& outer) {
  if (context_.component.empty()) context_.component = outer.component;
  if (!context_.frame) context_.frame = outer.frame;
  if (context_.camera.empty()) context_.camera = outer.camera;
}

UserError::UserError(const std::string& message) : Error(message), diagnostics_(1) {
  diagnostics_[0].message = message;
}

UserError::UserError(Diagnostic diagnostic)
    : Error(plaza::to_string(diagnostic)), diagnostics_{std::move(diagnostic)} {}

UserError::UserError(Diagnostics diagnostics)
    : Error(plaza::to_string(diagnostics)), diagnostics_(std::move(diagnostics)) {
  if (diagnostics_.empty()) throw std::invalid_argument("UserError without a diagnostic");
}

std::string to_string(const FaultContext& context) {
  std::string text;
  const auto add = [&text](const std::string& part) {
    if (!text.empty()) text += ", ";
    text += part;
  };
  if (!context.component.empty()) add("node '" + context.component + "'");
  if (context.frame) add("frame " + std::to_string(*context.frame + 1));
  if (!context.camera.empty()) add("camera '" + context.camera + "'");
  return text;
}

}  // namespace plaza
