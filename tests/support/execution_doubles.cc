#include "tests/support/execution_doubles.h"

#include "tests/support/double_behavior.h"

namespace plaza::test {

Counters& counters() {
  static Counters all;
  return all;
}

void register_doubles(ComponentRegistrar& registrar) {
  register_frame_doubles(registrar);
  register_people_doubles(registrar);
  register_result_doubles(registrar);
}

}  // namespace plaza::test
