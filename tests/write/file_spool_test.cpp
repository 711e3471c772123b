#include <csignal>
#include <filesystem>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/spool.hpp"
#include "support/spool_checks.hpp"
#include "support/temporary_folder.hpp"

namespace d2b {
namespace {

class SpoolFolder : public testing::Test {
  protected:
    [[nodiscard]] bool is_empty() const { return std::filesystem::is_empty(folder_.path()); }
    test::TemporaryFolder folder_;
};

TEST_F(SpoolFolder, GivesBackWhatIsInMemory) {
    FileSpool spool(folder_.path().string(), std::size_t{1} << 30);
    test::expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, GivesBackWhatIsInTheFile) {
    FileSpool spool(folder_.path().string(), 0);
    test::expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, GivesBackWhatIsPartlyInTheFile) {
    FileSpool spool(folder_.path().string(), 6'000'000);
    test::expect_gives_back(spool, 5'000'000);
}

TEST_F(SpoolFolder, IsThereForSeveralThreads) {
    FileSpool spool(folder_.path().string(), 100'000);
    test::expect_serves_threads(spool);
}

TEST_F(SpoolFolder, ItsFileHasNoName) {
    FileSpool spool(folder_.path().string(), 0);
    spool.append(test::some_bytes(10'000'000, 1));
    EXPECT_TRUE(is_empty());
}

TEST_F(SpoolFolder, WithoutAFolderItSaysWhatToDo) {
    FileSpool spool((folder_.path() / "missing").string(), 100);
    EXPECT_EQ(spool.append(test::some_bytes(100, 1)), 0U);  // needs no file yet
    try {
        spool.append(test::some_bytes(100, 1));
        FAIL() << "no error";
    } catch (const OutputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "The finished part of the result cannot be kept in a temporary file in '" +
                      (folder_.path() / "missing").string() +
                      "': No such file or directory; set CPL_TMPDIR to a folder with room.");
    }
}

TEST_F(SpoolFolder, WithoutRoomItSaysWhatToDo) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1'000'000, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    FileSpool spool(folder_.path().string(), 0);
    std::string message;
    try {
        spool.append(test::some_bytes(5'000'000, 1));
    } catch (const OutputError& error) {
        message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_NE(message.find("File too large; set CPL_TMPDIR to a folder with room."), std::string::npos)
        << message;
}

}  // namespace
}  // namespace d2b
