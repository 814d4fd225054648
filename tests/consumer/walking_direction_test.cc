#include "walking_direction.h"

#include <plaza/contract/gtest.h>

namespace {

TEST(WalkingDirectionTest, KeepsTheContractOfDescribers) {
  plaza::contract::expect_kept(plaza::contract::subject_of<consumer::WalkingDirection>());
}

}  // namespace
