#pragma once

#include <string>

#include "plaza/component/declaration.h"
#include "plaza/core/error.h"

namespace plaza::test {

/// The parts of register_components(), a file each.
void register_test_images(ComponentRegistrar& registrar);   ///< test_images.cc
void register_test_people(ComponentRegistrar& registrar);   ///< test_people.cc
void register_test_parts(ComponentRegistrar& registrar);    ///< test_parts.cc
void register_test_results(ComponentRegistrar& registrar);  ///< test_results.cc

/// What a constructor throws when the value at `pointer` is wrong.
UserError fault(const std::string& pointer, const std::string& message);

}  // namespace plaza::test
