#pragma once

#include <memory>
#include <string_view>

#include "plaza/core/export.h"

namespace plaza {

/// What travels between nodes: immutable once emitted, shared, never copied. A payload type T names
/// its port in `static constexpr std::string_view kPort`; two types never share a port name.
class PLAZA_API Payload {
 public:
  virtual ~Payload();
  virtual std::string_view port() const noexcept = 0;

 protected:
  Payload() = default;
  Payload(const Payload&) = default;
  Payload& operator=(const Payload&) = default;
};

using PayloadPtr = std::shared_ptr<const Payload>;

/// Gives a payload struct its port() from T::kPort. The key function of T itself must be in the
/// library that defines the type.
template <class T>
class PayloadOf : public Payload {
 public:
  std::string_view port() const noexcept final { return T::kPort; }
};

}  // namespace plaza
