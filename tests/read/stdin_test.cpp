#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <cpl_conv.h>
#include <gtest/gtest.h>

#include "dem2buildings/open_sources.hpp"
#include "read/rasters.hpp"

namespace d2b::test {
namespace {

namespace fs = std::filesystem;

/// Every test reads its standard input in a process of its own, for a process has only one.
class ReadStdin : public ReadTest {
  protected:
    void SetUp() override {
        ReadTest::SetUp();
        folder_ =
            fs::path(::testing::TempDir()) /
            ("d2b_read_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "spool");
        input_ = (folder_ / "input").string();
        options_.source = "/vsistdin/";
    }
    void TearDown() override {
        fs::remove_all(folder_);
        ReadTest::TearDown();
    }
    void begin(const std::string& spool_folder) {
        ASSERT_NE(std::freopen(input_.c_str(), "rb", stdin), nullptr);
        CPLSetConfigOption("CPL_TMPDIR", spool_folder.c_str());
    }
    [[nodiscard]] std::string spool() const { return (folder_ / "spool").string(); }
    [[nodiscard]] std::ptrdiff_t spooled() const {
        return std::distance(fs::directory_iterator(spool()), fs::directory_iterator());
    }
    /// Ends the process: 0 where nothing has failed so far.
    [[noreturn]] static void end() { std::_Exit(HasFailure() ? 1 : 0); }

    fs::path folder_;
    std::string input_;
};

TEST_F(ReadStdin, isKeptInATemporaryFileWhileItIsUsed) {
    // Beyond the first megabyte, which is all that GDAL itself keeps of its standard input.
    const int size = 600;
    write(input_, {.cols = size, .rows = size, .values = counting(size * size)});
    EXPECT_EXIT(
        {
            begin(spool());
            std::unique_ptr<DemSource> source = open();
            EXPECT_EQ(source->info().name, "/vsistdin/");
            EXPECT_EQ(spooled(), 1);
            std::vector<double> row(size);
            source->read(whole_rows(*source, 599, 1), row);
            expect_values(row, counting(size, 599 * 600));
            source->read(whole_rows(*source, 0, 1), row);
            expect_values(row, counting(size));
            source.reset();
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, whatIsNoRasterLeavesNothingBehind) {
    write_text(input_, "not a raster");
    EXPECT_EXIT(
        {
            begin(spool());
            expect_has(message<InputError>(), "'/vsistdin/' cannot be opened as a raster: ");
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, nothingCameIn) {
    write_text(input_, "");
    EXPECT_EXIT(
        {
            begin(spool());
            EXPECT_EQ(message<InputError>(),
                      "Nothing came in on the standard input; send a raster to it or give a file.");
            EXPECT_EQ(spooled(), 0);
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

TEST_F(ReadStdin, noPlaceToKeepIt) {
    write_text(input_, "x");
    EXPECT_EXIT(
        {
            begin(spool() + "/none");
            EXPECT_EQ(message<OutputError>(),
                      "The standard input cannot be kept in a temporary file in '" + spool() +
                          "/none': No such file or directory; set CPL_TMPDIR to a folder with "
                          "room.");
            end();
        },
        ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace d2b::test
