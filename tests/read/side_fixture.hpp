#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "read/rasters.hpp"
#include "read/side_rasters.hpp"

namespace d2b::test {

/// A function of coordinates in the DEM's CRS.
using Surface = std::function<double(double, double)>;

/// Tests of data beside a DEM: "dem.tif" is the DEM, "side.tif" the raster beside it.
class SideTest : public ReadTest {
  protected:
    /// Writes the DEM, whose elevations do not matter, and takes its grid; options_ choose the window.
    void dem(RasterSpec spec);
    /// Writes side.tif with the surface's values at the centres of its cells, which it finds in `crs` by way
    /// of OGR: spec.crs and `crs` are codes, "" for coordinates that are the same.
    void side(RasterSpec spec, const Surface& surface, const std::string& crs = "");
    /// Values of the surface at the centres of the window's cells.
    [[nodiscard]] std::vector<double> expected(const Surface& surface) const;

    std::vector<double> terrain(double dem_vertical_metres = 1);
    std::vector<double> mask(const std::string& name = "side.tif", const std::string& layer = "");
    std::vector<double> ndvi();

    template <typename E>
    std::string refused(const std::function<void()>& call) {
        try {
            call();
        } catch (const E& error) {
            return error.what();
        } catch (const std::exception& error) {
            return std::string("another exception: ") + error.what();
        }
        return "no exception";
    }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    DemInfo grid_;
    std::int64_t outside_range_ = 0;  ///< cells of terrain()
};

/// Each value within `tolerance` of the expected one, NaN where that is NaN.
void expect_near(const std::vector<double>& got, const std::vector<double>& expected, double tolerance);

/// Rises by 3 % to the east and falls by 2 % to the north, 100 at (500000, 5538630).
[[nodiscard]] double plane(double x, double y);

}  // namespace d2b::test
