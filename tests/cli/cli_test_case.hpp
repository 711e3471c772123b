#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/read_back.hpp"
#include "read/rasters.hpp"
#include "support/run_tool.hpp"

namespace d2b::test {

using Arguments = std::vector<std::string>;

/// Runs the real program in an empty folder of its own.
class CliTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite();
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// All names in the folder and below, hidden ones too, sorted.
    [[nodiscard]] std::vector<std::string> entries() const;

    /// Names of files are taken from the test's folder.
    [[nodiscard]] ToolResult run(const Arguments& arguments, ToolSetup setup = {}) const;
    /// All must be well: status 0 and nothing on stderr. @return stdout
    std::string run_well(const Arguments& arguments, const ToolSetup& setup = {}) const;
    /// Status 0, and these and no other warnings. @param parts of the warnings, in their order
    std::string run_warned(const Arguments& arguments, const std::vector<std::string>& parts) const;
    /// The run must fail with one sentence that holds `part`, print nothing but progress, leave every file as
    /// it was and add none. @param warnings lines that may come before the error
    void expect_error(int status, const std::string& part, const Arguments& arguments,
                      const ToolSetup& setup = {}, int warnings = 0) const;

    [[nodiscard]] Layer layer(const std::string& file, const std::string& name) const;

    std::filesystem::path folder_;
    /// Preset of every run without one in its arguments: most tests look at single points and levels in any
    /// place. Empty: the program's own default.
    std::string preset_ = "thesis";
};

[[nodiscard]] std::string sample(const std::string& name);

/// 30 x 20 points of 1 m, ground 0. Points in rows 3 to 10 and columns 3 to 12 are at 10, and of these rows
/// 5 to 8 and columns 5 to 9 at 20; rows 5 to 7 and columns 18 to 21 are at 6; rows 10, 11 and columns 25, 26
/// at 8. Traced through points above 5 the buildings have areas of 63, 6 and 1 and rings of 32, 10 and 4
/// points; above 15 there is one of 12 and 14.
[[nodiscard]] RasterSpec blocks();
/// Gives cells of a raster an elevation, from a row and a column to the last ones.
void fill(RasterSpec& spec, int row, int last_row, int col, int last_col, double z);

/// Message with which the test is skipped if the file is missing.
[[nodiscard]] std::string missing_shared(const std::string& file);

}  // namespace d2b::test
