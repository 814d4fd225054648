#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "plaza/core/error.h"

namespace plaza::sources {

/// Reads rows with `read(file)`; every fault is added to `faults` with `pointer`, and what was read
/// so far of a faulty file is not used.
template <class Read>
auto rows_of(const std::filesystem::path& file, const std::string& pointer, const Read& read,
             Diagnostics& faults) -> decltype(read(file)) {
  if (std::string fault = file_fault(file); !fault.empty()) {
    faults.push_back(fault_at(pointer, std::move(fault)));
    return {};
  }
  try {
    return read(file);
  } catch (const UserError& error) {
    for (Diagnostic fault : error.diagnostics()) {
      fault.pointer = pointer;
      faults.push_back(std::move(fault));
    }
    return {};
  }
}

}  // namespace plaza::sources
