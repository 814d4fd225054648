#include "framework/execution/run_faults.h"

#include "framework/execution/guard.h"

namespace plaza {

void RunFaults::keep(const std::exception_ptr& fault) {
  if (first_) {
    further_ += "; also failed: " + describe(fault);
  } else {
    first_ = fault;
  }
}

std::string RunFaults::text() const { return describe(first_) + further_; }

void RunFaults::rethrow() const {
  if (first_) std::rethrow_exception(first_);
}

}  // namespace plaza
