#include "core/block_pool.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <vector>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <gtest/gtest.h>

#include "core/grid.hpp"

namespace d2b {
namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;

TEST(BlockPool, HandsOnWhatFits) {
    BlockPool pool;
    void* const block = pool.take(25 * megabyte);
    *static_cast<char*>(block) = 'x';
    pool.give(block, 25 * megabyte);
    void* const other = pool.take(25 * megabyte - 1000);  // in whole pages both are 25 MiB
    EXPECT_EQ(other, block);
    EXPECT_EQ(*static_cast<char*>(other), 'x');
    void* const second = pool.take(25 * megabyte);
    EXPECT_NE(second, block);
    pool.give(other, 25 * megabyte - 1000);
    pool.give(second, 25 * megabyte);
}

TEST(BlockPool, GivesBackWhatWaitsBeforeItAsksForMore) {
    BlockPool pool;
    void* const block = pool.take(4 * megabyte);
    *static_cast<char*>(block) = 'x';
    pool.give(block, 4 * megabyte);
    void* const larger = pool.take(8 * megabyte);
    void* const anew = pool.take(4 * megabyte);
    EXPECT_EQ(*static_cast<char*>(anew), 0);  // the system's pages are cleared
    pool.give(larger, 8 * megabyte);
    pool.give(anew, 4 * megabyte);
}

TEST(BlockPool, PutsWhatWaitsTogether) {
    BlockPool pool;
    constexpr std::size_t page = LargePages::size;
    constexpr std::size_t beyond = megabyte / 2;  // no large page
    const std::vector<std::size_t> sizes{3 * page + beyond, 2 * page, 4 * page};
    std::vector<char*> blocks;
    for (const std::size_t size : sizes)
        blocks.push_back(static_cast<char*>(pool.take(size)));
    char mark = 'a';
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        for (std::size_t at = 0; at < sizes[k]; at += page)
            blocks[k][at] = mark++;
        pool.give(blocks[k], sizes[k]);
    }
    // a b c (d) | e f | g h i j: the large pages of those that wait longest, of the last as many as it needs
    auto* const block = static_cast<char*>(pool.take(7 * page + beyond));
    std::string held;
    for (std::size_t at = 0; at <= 7 * page; at += page)
        held += block[at] == 0 ? '.' : block[at];
    EXPECT_EQ(held, "abcefgh.");
    auto* const rest = static_cast<char*>(pool.take(2 * page));
    EXPECT_EQ(rest[0], 'i');
    EXPECT_EQ(rest[page], 'j');
    pool.give(block, 7 * page + beyond);
    pool.give(rest, 2 * page);
}

TEST(BlockPool, PutsWhatIsPutTogetherTogetherAgain) {
    BlockPool pool;
    constexpr std::size_t page = LargePages::size;
    const std::vector<char*> blocks{static_cast<char*>(pool.take(page)),
                                    static_cast<char*>(pool.take(2 * page))};
    blocks[0][0] = 'x';
    blocks[1][page] = 'y';
    pool.give(blocks[0], page);
    pool.give(blocks[1], 2 * page);
    pool.give(pool.take(3 * page), 3 * page);
    auto* const larger = static_cast<char*>(pool.take(4 * page));
    EXPECT_EQ(larger[0], 'x');
    EXPECT_EQ(larger[2 * page], 'y');
    EXPECT_EQ(larger[3 * page], 0);
    larger[4 * page - 1] = 'z';
    pool.give(larger, 4 * page);
}

TEST(BlockPool, HoldsNoMoreThanWasInUseAtATime) {
    BlockPool pool;
    constexpr std::size_t bytes = 4 * megabyte;
    std::vector<void*> blocks;
    for (int i = 0; i < 3; ++i)
        blocks.push_back(pool.take(bytes));
    for (void* const block : blocks) {
        *static_cast<char*>(block) = 'x';
        pool.give(block, bytes);
    }
    void* const larger = pool.take(2 * bytes);  // in the place of two that wait
    for (void*& block : blocks)
        block = pool.take(bytes);
    EXPECT_EQ(*static_cast<char*>(blocks[0]), 'x');
    EXPECT_EQ(*static_cast<char*>(blocks[1]), 0);
    EXPECT_EQ(*static_cast<char*>(blocks[2]), 0);
    for (void* const block : blocks)
        pool.give(block, bytes);
    pool.give(larger, 2 * bytes);
}

#if !D2B_SANITIZED && defined(__linux__)
/// Leaves so many bytes of addresses beside those that are taken, as long as it lives.
class FewAddresses {
  public:
    explicit FewAddresses(std::size_t bytes) {
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        getrlimit(RLIMIT_AS, &before_);
        const rlimit few{pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + bytes, before_.rlim_max};
        setrlimit(RLIMIT_AS, &few);
    }
    FewAddresses(const FewAddresses&) = delete;
    FewAddresses& operator=(const FewAddresses&) = delete;
    ~FewAddresses() { setrlimit(RLIMIT_AS, &before_); }

  private:
    rlimit before_{};
};

TEST(BlockPool, GivesBackFirstWhereThereIsNoRoomBeside) {
    BlockPool pool;
    pool.give(pool.take(64 * megabyte), 64 * megabyte);
    void* block = nullptr;
    {
        const FewAddresses few(20 * megabyte);
        EXPECT_THROW((void)LargePages::map(48 * megabyte), std::bad_alloc);
        block = pool.take(48 * megabyte);
        EXPECT_EQ(*static_cast<char*>(block), 0);
        EXPECT_THROW((void)pool.take(256 * megabyte), std::bad_alloc);
    }
    pool.give(block, 48 * megabyte);
}
#endif

TEST(BlockPool, HoldsNothingOnceItIsCleared) {
    BlockPool pool;
    void* block = pool.take(4 * megabyte);
    *static_cast<char*>(block) = 'x';
    pool.give(block, 4 * megabyte);
    pool.clear();
    block = pool.take(4 * megabyte);
    EXPECT_EQ(*static_cast<char*>(block), 0);
    pool.give(block, 4 * megabyte);
}

TEST(BlockPool, SaysThatThereIsNoRoom) {
    BlockPool pool;
    EXPECT_THROW((void)pool.take(std::numeric_limits<std::size_t>::max()), std::bad_alloc);
    EXPECT_THROW((void)pool.take(std::numeric_limits<std::size_t>::max() / 2), std::bad_alloc);
}

TEST(Grids, TakeTheMemoryOfThoseBefore) {
    Executor threads(2);
    const std::uint8_t* before = nullptr;
    {
        const Grid<std::uint8_t> grid(3000, 3000, 7, threads);
        EXPECT_TRUE(std::ranges::all_of(grid.values, [](int value) { return value == 7; }));
        before = grid.values.data();
    }
    const Grid<std::uint8_t> grid = Grid<std::uint8_t>::unset(3000, 3000, threads);
    EXPECT_EQ(grid.values.data(), before);
    EXPECT_EQ(grid.at(2999, 2999), 7);
}

TEST(Grids, OutliveTheThreadsThatTheyWereMadeWith) {
    Grid<float> grid;
    {
        Executor threads(2);
        grid = Grid<float>(1000, 1000, 2.5F, threads);
    }
    const Grid<float> copy = grid;
    grid = {};
    EXPECT_EQ(copy.at(999, 999), 2.5F);
}

}  // namespace
}  // namespace d2b
