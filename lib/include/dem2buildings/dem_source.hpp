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

/// The six terms of GDAL's affine transform, from (column, row) to coordinates:
/// x = g[0] + column g[1] + row g[2], y = g[3] + column g[4] + row g[5]; (0, 0) is the outer corner of the
/// first cell. Rotated, south-up and non-square grids are all of this form.
using AffineTransform = std::array<double, 6>;

/// What is known of a DEM before its elevations are read. Plain values: the algorithm never sees a file.
struct DemInfo {
    std::string name;       ///< as the user gave it; for messages and provenance
    std::int32_t rows = 0;  ///< of the whole raster
    std::int32_t cols = 0;  ///< of the whole raster
    Window window;          ///< the part that is used; rows and columns stay those of the whole raster
    AffineTransform transform{0, 1, 0, 0, 0, -1};  ///< without georeferencing: pixels, y up
    bool georeferenced = false;
    std::string crs_wkt;  ///< WKT2:2019, empty where there is none
    std::string
        band_unit;      ///< the band's unit of elevation as stated, e.g. "metre", "US survey foot"; may be ""
    double scale = 1;   ///< elevation = value as stored * scale + offset
    double offset = 0;  ///< of the same
    /// The elevation that the file's own NoData value becomes, where an option says that it is none.
    std::optional<double> set_aside_nodata;
    std::string driver;      ///< short name of the format, for the report
    std::int32_t bands = 1;  ///< of the whole raster
    bool bytes = false;      ///< the band's values are whole numbers from 0 to 255
    std::int32_t block_rows =
        1;  ///< rows that are decoded together; bands that keep to multiples of it are read once
};

/// Where elevations come from: a file (read/), or an array in tests and in other programs.
class DemSource {
  public:
    DemSource() = default;
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;
    virtual ~DemSource() = default;

    [[nodiscard]] virtual const DemInfo& info() const = 0;

    /// Elevations of a part of the window, row by row, in the band's vertical unit with scale and offset
    /// applied; NaN where a point is not valid (NoData, mask, alpha, NaN, infinite, outside the cutline).
    /// Which part is asked for does not change the value of a point. Several threads may call it at a time.
    /// @param part       rows and columns of the whole raster, inside the window
    /// @param elevations part.rows * part.cols values
    /// @throws InputError
    virtual void read(const Window& part, std::span<double> elevations) = 0;

    /// What reading it has shown since the last call, a sentence each, for the run to warn of. Called from
    /// the thread that called run(), while others may read.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
    /// Of a terrain model, the share of the window that lies outside of it.
    [[nodiscard]] virtual double share_outside() const { return 0; }
    /// Of a terrain model, cells that are not valid because no elevation can be what they hold, of those that
    /// have been read.
    [[nodiscard]] virtual std::int64_t cells_outside_range() const { return 0; }
};

/// How a DEM is read: in bands of rows, which are kept from one pass to the next where they fit.
struct BandSize {
    /// Of a band, in whole multiples of the usual block heights; more where blocks are higher. Some 4 MiB.
    std::int64_t points = 1 << 19;
    /// Most that is kept: 4 a point where that loses nothing, else 8.
    std::size_t keep_bytes = std::size_t{512} << 20;
};

}  // namespace d2b
