// The test components as a plugin library, for tests of the program itself.
#include "plaza/plugin.h"
#include "tests/support/test_components.h"

PLAZA_PLUGIN(registrar) { plaza::test::register_components(registrar); }
