#include "tests/support/test_components.h"

#include <utility>

#include "tests/support/into_registry.h"
#include "tests/support/test_component_groups.h"

namespace plaza::test {

UserError fault(const std::string& pointer, const std::string& message) {
  Diagnostic diagnostic;
  diagnostic.pointer = pointer;
  diagnostic.message = message;
  return UserError(std::move(diagnostic));
}

void register_components(ComponentRegistrar& registrar) {
  register_test_images(registrar);
  register_test_people(registrar);
  register_test_parts(registrar);
  register_test_results(registrar);
}

Registry make_registry() {
  Registry registry;
  IntoRegistry registrar(registry);
  register_components(registrar);
  return registry;
}

std::shared_ptr<const Scene> make_scene() { return std::make_shared<Scene>(); }

}  // namespace plaza::test
