#include "tiles/recent_files.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include <gtest/gtest.h>

namespace d2b {
namespace {

namespace fs = std::filesystem;

class RecentFilesTest : public testing::Test {
  protected:
    RecentFilesTest() {
        std::string name = (fs::temp_directory_path() / "d2b-recent-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        for (const char* one : {"a", "b", "c"})
            std::ofstream(folder_ / one) << one;
    }
    ~RecentFilesTest() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    [[nodiscard]] std::shared_ptr<const OpenFile> open(const char* name) {
        return files_.open(folder_ / name);
    }
    static char letter(const OpenFile& file) {
        std::array<std::byte, 1> bytes{};
        return file.read(0, bytes) ? static_cast<char>(bytes[0]) : '?';
    }

    fs::path folder_;
    RecentFiles files_{RecentFiles::ReadAhead::none, 2};
};

TEST_F(RecentFilesTest, StayOpenUntilTooManyOthersWereRead) {
    const std::weak_ptr<const OpenFile> a = open("a");
    const std::weak_ptr<const OpenFile> b = open("b");
    EXPECT_EQ(open("a"), a.lock());
    EXPECT_EQ(letter(*open("c")), 'c');
    EXPECT_FALSE(a.expired());
    EXPECT_TRUE(b.expired());
    EXPECT_EQ(letter(*open("b")), 'b');
    EXPECT_TRUE(a.expired());
}

TEST_F(RecentFilesTest, StayOpenForThoseWhoHaveThem) {
    const auto a = open("a");
    for (const char* other : {"b", "c", "b", "c"})
        EXPECT_EQ(letter(*open(other)), other[0]);
    EXPECT_EQ(letter(*a), 'a');
}

TEST_F(RecentFilesTest, AreLookedForAgainWhereThereWasNone) {
    EXPECT_FALSE(open("d")->is_open());
    std::ofstream(folder_ / "d") << "d";
    EXPECT_EQ(letter(*open("d")), 'd');
}

}  // namespace
}  // namespace d2b
