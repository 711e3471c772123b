#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <gdal.h>
#include <gtest/gtest.h>

#include "core/warnings.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/options.hpp"

namespace d2b::test {

/// A raster to be written; every band holds the same values unless it is filled by hand.
struct RasterSpec {
    int cols = 1;
    int rows = 1;
    GDALDataType type = GDT_Float64;
    std::vector<double> values = {};  ///< rows * cols, row by row; none: the raster is left as it was created
    std::optional<std::array<double, 6>> transform = std::array<double, 6>{0, 1, 0, 0, 0, -1};
    std::string crs = "EPSG:25832";  ///< "" for none
    std::optional<double> nodata = {};
    int bands = 1;
    std::string driver = "GTiff";
    std::vector<std::string> creation = {};
};

/// The numbers first, first + 1, ... first + count - 1.
std::vector<double> counting(int count, double first = 0);

/// Creates a raster that is still open for change; whoever asked closes it.
GDALDatasetH create(const std::string& path, const RasterSpec& spec);
/// Creates a raster and closes it.
void write(const std::string& path, const RasterSpec& spec);
void write_text(const std::string& path, const std::string& text);
std::string read_bytes(const std::string& path);

/// Tests that read rasters from a folder in memory of their own.
class ReadTest : public ::testing::Test {
  protected:
    static void SetUpTestSuite();
    void SetUp() override;
    void TearDown() override;

    /// A path in the test's own folder.
    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + name; }
    /// The path as messages write it, in quotes.
    [[nodiscard]] std::string quoted(const std::string& name) const;
    /// Opens the raster that options_ describes; `name` is a file in the folder, or "" for options_.source as
    /// it is.
    std::unique_ptr<DemSource> open(const std::string& name = "");
    /// All elevations of the window, read at once, and the warnings that come of it.
    std::vector<double> all_of(DemSource& source);
    /// The same of a file.
    std::vector<double> values(const std::string& name = "");
    /// The message of the exception of type E that opening and reading everything throws.
    template <typename E>
    std::string message(const std::string& name = "") {
        try {
            values(name);
        } catch (const E& error) {
            return error.what();
        } catch (const std::exception& error) {
            return std::string("another exception: ") + error.what();
        }
        return "no exception";
    }

    ReadOptions options_;
    std::vector<std::string> warnings_;  ///< told
    Callbacks callbacks_;                ///< which tell
    Warnings heard_{[this](const std::string& text) { warnings_.push_back(text); }};

  private:
    std::string folder_;
};

std::vector<double> read_all(DemSource& source);
/// Rows of the window of a source, from a row of the whole raster on.
Window whole_rows(const DemSource& source, std::int32_t first, std::int32_t rows);
/// Returns the WKT of a CRS of EPSG.
std::string wkt_of(int epsg);
/// Returns the grid of a DEM of 20 x 20 cells of 1 m, "dem.tif" in EPSG:25832.
DemInfo metre_grid();

}  // namespace d2b::test

/// Values in order, NaN equal to NaN.
void expect_values(const std::vector<double>& got, const std::vector<double>& expected);
/// `part` occurs in `text`.
void expect_has(const std::string& text, const std::string& part);

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();
