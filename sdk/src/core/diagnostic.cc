#include "plaza/core/diagnostic.h"

#include <utility>

namespace plaza {

Diagnostic fault_at(std::string pointer, std::string message) {
  Diagnostic fault;
  fault.pointer = std::move(pointer);
  fault.message = std::move(message);
  return fault;
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string text;
  const FilePosition& where = diagnostic.where;
  if (!where.file.empty()) {
    text += where.file + ":";
    if (where.line > 0) text += std::to_string(where.line) + ":";
    if (where.line > 0 && where.column > 0) text += std::to_string(where.column) + ":";
    text += " ";
  }
  if (!diagnostic.pointer.empty()) text += diagnostic.pointer + ": ";
  return text + diagnostic.message;
}

std::string to_string(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(d);
  }
  return text;
}

}  // namespace plaza
