#include <cstdint>
#include <limits>
#include <new>

#include <gtest/gtest.h>

#include "core/block_pool.hpp"

namespace d2b {
namespace {

constexpr std::size_t large_page = LargePages::size;

TEST(LargePages, BeginBlocksAndAreCleared) {
    auto* const block = static_cast<char*>(LargePages::map(large_page + 1));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % large_page, 0);
    EXPECT_EQ(block[0], 0);
    EXPECT_EQ(block[large_page], 0);
    LargePages::unmap(block, large_page + 1);
}

TEST(LargePages, WholePagesHoldAllBytes) {
    EXPECT_EQ(LargePages::whole(1), LargePages::whole(4096));
    EXPECT_GE(LargePages::whole(3 * large_page + 1), 3 * large_page + 1);
    EXPECT_LT(LargePages::whole(3 * large_page + 1),
              4 * large_page);  // else small blocks would need twice their memory
    EXPECT_EQ(LargePages::in(3 * large_page + 1), 3 * large_page);
    EXPECT_THROW((void)LargePages::whole(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
}

TEST(LargePages, MoveWithWhatIsInThem) {
    auto* const from = static_cast<char*>(LargePages::map(2 * large_page));
    auto* const to = static_cast<char*>(LargePages::map(3 * large_page));
    from[0] = 'a';
    from[large_page + 5] = 'b';
    to[2 * large_page] = 'c';
    ASSERT_TRUE(LargePages::move(from, to, 2 * large_page));
    EXPECT_EQ(to[0], 'a');
    EXPECT_EQ(to[large_page + 5], 'b');
    EXPECT_EQ(to[2 * large_page], 'c');
    LargePages::unmap(to, 3 * large_page);
}

TEST(LargePages, AreNewWhereTheyCannotMove) {
    auto* const from = static_cast<char*>(LargePages::map(3 * large_page));
    auto* const to = static_cast<char*>(LargePages::map(3 * large_page));
    from[0] = 'a';
    to[large_page] = 'b';
    LargePages::unmap(from + large_page, large_page);  // the system moves no memory that is not there
    ASSERT_TRUE(LargePages::move(from, to, 3 * large_page));
    EXPECT_EQ(to[0], 'a');
    EXPECT_EQ(to[large_page], 0);
    to[3 * large_page - 1] = 'c';
    LargePages::unmap(to, 3 * large_page);
}

}  // namespace
}  // namespace d2b
