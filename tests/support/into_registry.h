#pragma once

#include <utility>

#include "framework/plugin/registry.h"
#include "plaza/component/declaration.h"

namespace plaza::test {

/// Puts components of the test's own program, which come from no library, into a registry.
class IntoRegistry final : public ComponentRegistrar {
 public:
  explicit IntoRegistry(Registry& registry) : registry_(registry) {}

 private:
  void do_add(ComponentDeclaration declaration, ComponentFactory factory) override {
    registry_.add({.declaration = std::move(declaration),
                   .factory = std::move(factory),
                   .library = {},
                   .library_handle = nullptr});
  }

  Registry& registry_;
};

}  // namespace plaza::test
