// The doubles as a plugin library, for tests of the program itself.
#include "plaza/plugin.h"
#include "tests/support/execution_doubles.h"

PLAZA_PLUGIN(registrar) { plaza::test::register_doubles(registrar); }
