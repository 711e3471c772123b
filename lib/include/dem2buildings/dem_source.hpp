#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace d2b {

/// Rows and columns of the source raster, half open: [row, row + rows) x [col, col + cols).
struct Window {
    std::int32_t row = 0;
    std::int32_t col = 0;
    std::int32_t rows = 0;
    std::int32_t cols = 0;

    [[nodiscard]] std::int32_t end_row() const { return row + rows; }
    [[nodiscard]] std::int32_t end_col() const { return col + cols; }
    [[nodiscard]] std::int64_t points() const { return std::int64_t{rows} * cols; }
    [[nodiscard]] bool holds(std::int32_t r, std::int32_t c) const {
        return r >= row && r < end_row() && c >= col && c < end_col();
    }

    friend bool operator==(const Window&, const Window&) = default;
};

/// Coefficients of GDAL's affine transform, from (column, row) to coordinates: x = g[0] + column g[1] + row
/// g[2], y = g[3] + column g[4] + row g[5]; (0, 0) is the outer corner of the first cell. Covers rotated,
/// south-up and non-square grids.
using AffineTransform = std::array<double, 6>;

/// Properties of a DEM that are known before its elevations are read. Plain values, because the algorithm
/// never accesses files.
struct DemInfo {
    std::string name;       ///< name given by the user; for messages and provenance
    std::int32_t rows = 0;  ///< size of the whole raster
    std::int32_t cols = 0;  ///< size of the whole raster
    Window window;          ///< part to process; rows and cols remain those of the whole raster
    AffineTransform transform{0, 1, 0, 0, 0, -1};  ///< without georeferencing: pixels, y up
    bool georeferenced = false;
    std::string crs_wkt;  ///< WKT2:2019; empty if there is none
    std::string
        band_unit;      ///< unit of elevation stated by the band, e.g. "metre", "US survey foot"; may be ""
    double scale = 1;   ///< elevation = stored value * scale + offset
    double offset = 0;  ///< see scale
    std::optional<double> nodata;  ///< elevation of the NoData value in use; nothing if there is none, or NaN
    /// Elevation of the file's own NoData value, if an option says to use it as an elevation.
    std::optional<double> overridden_nodata;
    std::string driver;      ///< short name of the format, for the report
    std::string date;        ///< of the elevations, or else of the file, such as "2024-05-31"; "" if unknown
    std::int32_t bands = 1;  ///< number of bands of the raster
    bool bytes = false;      ///< true if the band's values are integers from 0 to 255
    std::int32_t block_rows =
        1;  ///< rows decoded together; reading in multiples of it decodes each block once
};

/// Source of elevations: a file (see open_dem()), or an array of a program or test.
///
/// Implement it for data that GDAL cannot read. For an array in memory use open_dem(ElevationArray), which
/// needs no class.
class DemSource {
  public:
    DemSource() = default;
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;
    virtual ~DemSource() = default;

    [[nodiscard]] virtual const DemInfo& info() const = 0;

    /// Reads elevations of a part of the window, row by row, in the band's vertical unit with scale and
    /// offset applied; NaN if a point is not valid (NoData, mask, alpha, NaN, infinite, outside the cutline).
    /// The value of a point does not depend on the part. Must be thread-safe.
    /// @param part rows and columns of the whole raster, inside the window
    /// @param elevations part.rows * part.cols values
    /// @throws InputError
    virtual void read(const Window& part, std::span<double> elevations) = 0;

    /// Returns warnings since the last call, one sentence each. Called from the thread that called run(),
    /// while others may read.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
    /// Returns the share of the window outside of a terrain model.
    [[nodiscard]] virtual double share_outside() const { return 0; }
    /// Returns the number of cells of a terrain model that were read and rejected as impossible elevations.
    [[nodiscard]] virtual std::int64_t cells_outside_range() const { return 0; }
};

/// Size of the bands of rows in which a DEM is read. Bands are cached between passes if they fit.
struct BandSize {
    /// Points per band, a multiple of the usual block heights; more if blocks are higher. Some 4 MiB.
    std::int64_t points = 1 << 19;
    /// Size of the cache: 4 bytes per point if that is lossless, otherwise 8.
    std::size_t keep_bytes = std::size_t{512} << 20;
};

}  // namespace d2b
