#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "core/system/data_folder.hpp"
#include "core/system/file.hpp"
#include "core/system/paths.hpp"
#include "core/system/process.hpp"
#include "core/system/text_number.hpp"
#include "support/temporary_folder.hpp"

namespace d2b::system {
namespace {

namespace fs = std::filesystem;

class SystemTest : public testing::Test {
  protected:
    fs::path made(const char* name, const std::string& text) {
        std::ofstream(folder_.path() / name) << text;
        return folder_.path() / name;
    }
    static std::string text_of(const fs::path& path) {
        std::ifstream file(path);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::string pattern() const { return (folder_.path() / "new_XXXXXX").string(); }
    [[nodiscard]] std::ptrdiff_t names() const {
        return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
    }

    test::TemporaryFolder folder_;
};

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

TEST_F(SystemTest, ReadsAllOfTheBytesOrNone) {
    const File file(made("häuser", "0123456789"), File::Mode::read);
    ASSERT_TRUE(file.is_open());
    EXPECT_EQ(file.size(), 10);
    std::array<char, 4> text{};
    ASSERT_TRUE(file.read(6, std::as_writable_bytes(std::span(text))));
    EXPECT_EQ(std::string(text.begin(), text.end()), "6789");
    errno = 0;
    EXPECT_FALSE(file.read(7, std::as_writable_bytes(std::span(text))));
    EXPECT_EQ(errno, EIO);
}

TEST_F(SystemTest, WritesBehindWhatIsWritten) {
    const fs::path path = made("a", "longer than the new text");
    {
        const File file(path, File::Mode::write);
        ASSERT_TRUE(file.write(bytes_of("one ")) && file.write(bytes_of("two")) && file.sync());
    }
    EXPECT_EQ(text_of(path), "one two");
}

TEST_F(SystemTest, TellsWhyAFileCannotBeOpened) {
    errno = 0;
    EXPECT_FALSE(File(folder_.path() / "missing", File::Mode::read).is_open());
    EXPECT_EQ(errno, ENOENT);
}

TEST_F(SystemTest, MakesTemporaryFilesWithAndWithoutNames) {
    std::string kept = pattern();
    std::string unnamed = pattern();
    const File one(kept, File::Name::kept);
    const File other(unnamed, File::Name::none);
    ASSERT_TRUE(one.is_open() && other.is_open());
    EXPECT_EQ(names(), 1);
    EXPECT_TRUE(fs::exists(kept));
    EXPECT_EQ(other.write_at(3, bytes_of("abc")), 3);
    std::array<std::byte, 3> back{};
    ASSERT_TRUE(other.read(3, back));
    EXPECT_EQ(back[0], std::byte{'a'});
}

TEST_F(SystemTest, MakesFoldersOfNewNames) {
    std::string one = pattern();
    std::string other = pattern();
    ASSERT_TRUE(make_unique_folder(one) && make_unique_folder(other));
    EXPECT_NE(one, other);
    EXPECT_TRUE(fs::is_directory(one) && fs::is_directory(other));
}

TEST_F(SystemTest, RenamesToFreeNamesAlone) {
    const fs::path from = made("from", "a");
    const fs::path to = made("to", "b");
    const int taken = rename_to_free_name(from, to);
    EXPECT_TRUE(taken == EEXIST || is_unsupported(taken));
    EXPECT_EQ(text_of(to), "b");
    const int moved = rename_to_free_name(from, folder_.path() / "free");
    EXPECT_TRUE(is_unsupported(moved) || text_of(folder_.path() / "free") == "a");
}

TEST_F(SystemTest, ReplacesAndExchangesFiles) {
    const fs::path one = made("one", "1");
    const fs::path other = made("other", "2");
    const int error = exchange(one, other);
    ASSERT_TRUE(error == 0 || is_unsupported(error));
    EXPECT_EQ(text_of(other), error == 0 ? "1" : "2");
    const std::string expected = text_of(one);
    ASSERT_EQ(replace(one, other), 0);
    EXPECT_EQ(text_of(other), expected);
    EXPECT_FALSE(fs::exists(one));
    EXPECT_EQ(replace(one, other), ENOENT);
}

TEST_F(SystemTest, StampsChangeWithTheFile) {
    const fs::path path = made("a", "1");
    const std::string before = stamp_of(path);
    EXPECT_EQ(stamp_of(path), before);
    made("a", "12");
    EXPECT_NE(stamp_of(path), before);
    EXPECT_EQ(stamp_of(folder_.path() / "missing"), "");
    EXPECT_EQ(write_refusal(path), 0);
    EXPECT_EQ(write_refusal(folder_.path() / "missing"), ENOENT);
    EXPECT_EQ(sync(path), 0);
    EXPECT_EQ(sync(folder_.path()), 0);
}

TEST(System, ReadsNumbersAsInTheLocaleC) {
    const std::string text = "1.5e3,7";
    char* end = nullptr;
    EXPECT_EQ(text_to_double(text.c_str(), &end), 1500);
    EXPECT_EQ(std::string(end), ",7");
    EXPECT_EQ(text_to_float("0.1", &end), 0.1F);
}

TEST_F(SystemTest, FindsDataBesideAModuleAndAboveAProgram) {
    const fs::path copy = folder_.path() / "copy";
    fs::create_directories(copy / "data" / "gdal");
    EXPECT_EQ(data_folder_of(copy / "module.so"), "");
    fs::create_directories(copy / "data" / "proj");
    std::ofstream(copy / "data" / "proj" / "proj.db") << "database";
    EXPECT_EQ(data_folder_of(copy / "module.so"), copy / "data");
    EXPECT_EQ(data_folder_of(copy / "bin" / "program"), copy / "data");
    EXPECT_EQ(data_folder_of(copy / "lib" / "bin" / "program"), "");
    EXPECT_EQ(data_folder_of(folder_.path() / "program"), "");
}

TEST(System, BringsNoDataAlongHere) {
    EXPECT_EQ(data_beside_program(), "");
}

TEST(System, LeavesOutTheNameOfTheProgram) {
    const std::array<const char*, 3> words{"program", "-a", "häuser"};
    EXPECT_EQ(arguments(3, words.data()), (std::vector<std::string>{"-a", "häuser"}));
    EXPECT_TRUE(arguments(0, words.data()).empty());
}

}  // namespace
}  // namespace d2b::system
