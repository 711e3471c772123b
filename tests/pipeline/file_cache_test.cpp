#include "pipeline/tiles/file_cache.hpp"

#include <array>
#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace d2b::tiles {
namespace {

class FileCacheTest : public testing::Test {
  protected:
    FileCacheTest() {
        for (const char* one : {"a", "b", "c"})
            std::ofstream(folder_.path() / one) << one;
    }
    [[nodiscard]] std::shared_ptr<const system::File> open(const char* name) {
        return files_.open(folder_.path() / name);
    }
    static char letter(const system::File& file) {
        std::array<std::byte, 1> bytes{};
        return file.read(0, bytes) ? static_cast<char>(bytes[0]) : '?';
    }

    test::TemporaryFolder folder_;
    FileHandleCache files_{2};
};

TEST_F(FileCacheTest, StayOpenUntilTooManyOthersWereRead) {
    const std::weak_ptr<const system::File> a = open("a");
    const std::weak_ptr<const system::File> b = open("b");
    EXPECT_EQ(open("a"), a.lock());
    EXPECT_EQ(letter(*open("c")), 'c');
    EXPECT_FALSE(a.expired());
    EXPECT_TRUE(b.expired());
    EXPECT_EQ(letter(*open("b")), 'b');
    EXPECT_TRUE(a.expired());
}

TEST_F(FileCacheTest, StayOpenForThoseWhoHaveThem) {
    const auto a = open("a");
    for (const char* other : {"b", "c", "b", "c"})
        EXPECT_EQ(letter(*open(other)), other[0]);
    EXPECT_EQ(letter(*a), 'a');
}

TEST_F(FileCacheTest, AreLookedForAgainWhereThereWasNone) {
    EXPECT_FALSE(open("d")->is_open());
    std::ofstream(folder_.path() / "d") << "d";
    EXPECT_EQ(letter(*open("d")), 'd');
}

}  // namespace
}  // namespace d2b::tiles
