#include "base/counted.h"

#include <gtest/gtest.h>
#include <cstdint>

namespace lfdsim {
namespace {

TEST(Counted, AgreesInNumber) {
    EXPECT_EQ(counted(1, "row"), "1 row");
    EXPECT_EQ(counted(0, "row"), "0 rows");
    EXPECT_EQ(counted(std::size_t(21), "row"), "21 rows");
    EXPECT_EQ(counted(std::int64_t(1), "lens", "lenses"), "1 lens");
    EXPECT_EQ(counted(2, "lens", "lenses"), "2 lenses");
}

}  // namespace
}  // namespace lfdsim
