#include "engine/devices/memory.h"
#include "engine/devices/threads.h"

#include <gmock/gmock.h>

#include "base/input_error.h"

namespace lfdsim {
namespace {

TEST(MemoryBudget, IsSharedByAll) {
    MemoryBudget budget(100e3);
    auto one = budget.claim("a", "one", 60e3);
    EXPECT_FALSE(budget.fits(50e3));
    EXPECT_THROW(static_cast<void>(budget.claim("b", "two", 50e3)), InputError);
    one.shrink(40e3);
    {
        const auto two = budget.claim("b", "two", 50e3);
        EXPECT_FALSE(budget.fits(20e3));
    }
    EXPECT_TRUE(budget.fits(60e3));
    MemoryBudget::Claim other = std::move(one);
    one = {};
    EXPECT_FALSE(budget.fits(61e3));
    other = {};
    EXPECT_TRUE(budget.fits(100e3));
}

TEST(MemoryBudget, IsWithinWhatIsFree) {
    MemoryBudget budget(1e18);
    try {
        static_cast<void>(budget.claim("panel.pixels", "a panel", 1e17));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems[0].where, "panel.pixels");
        EXPECT_THAT(error.problems[0].what, testing::MatchesRegex("a panel needs 100000000.0 GB of memory; .* [0-9.]+ [GM]B free"));
    }
}

TEST(Threads, AreTried) {
    EXPECT_EQ(threads_to_be_had(0), 0);
    EXPECT_EQ(threads_to_be_had(3), 3);
}

}  // namespace
}  // namespace lfdsim
