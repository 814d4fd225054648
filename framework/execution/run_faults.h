#pragma once

#include <exception>
#include <string>

namespace plaza {

/// What went wrong in a run. The first fault is the run's; what fails after it stands behind it in
/// the summary.
class RunFaults {
 public:
  void keep(const std::exception_ptr& fault);
  /// Keeps what `step` throws; false when it did.
  template <class Step>
  bool attempt(const Step& step) {
    try {
      step();
      return true;
    } catch (...) {
      keep(std::current_exception());
      return false;
    }
  }

  bool any() const { return first_ != nullptr; }
  /// All of them; there must be one.
  std::string text() const;
  /// Throws the first one, if there is any.
  void rethrow() const;

 private:
  std::exception_ptr first_;
  std::string further_;
};

}  // namespace plaza
