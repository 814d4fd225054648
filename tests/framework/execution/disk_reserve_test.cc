// Space that a run holds back for its results.
#include "framework/execution/disk_reserve.h"

#include <gtest/gtest.h>

#include "tests/support/execution_doubles.h"

namespace plaza {
namespace {

namespace fs = std::filesystem;

class DiskReserveTest : public testing::Test {
 protected:
  std::uintmax_t available() const { return fs::space(folder_.path()).available; }
  test::TemporaryFolder folder_;
};

TEST_F(DiskReserveTest, HasNoNameAndGoesWithRelease) {
  DiskReserve reserve;
  reserve.hold(folder_.path(), 1 << 20);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  reserve.release();
  reserve.release();  // again is fine
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(DiskReserveTest, AFolderThatCanNotHoldItIsNoFault) {
  DiskReserve reserve;
  EXPECT_NO_THROW(reserve.hold("/nonexistent/folder", 1 << 20));
  EXPECT_NO_THROW(reserve.hold("/proc", 1 << 20));
}

}  // namespace
}  // namespace plaza
