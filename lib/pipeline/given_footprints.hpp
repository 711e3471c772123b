#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/band.hpp"
#include "core/context.hpp"
#include "core/crs.hpp"
#include "core/grid.hpp"
#include "core/statistics.hpp"
#include "dem2buildings/footprint_source.hpp"
#include "dem2buildings/spool.hpp"
#include "detect/footprint_fit.hpp"
#include "detect/units.hpp"
#include "features/run_setup.hpp"
#include "raster/row_spans.hpp"

namespace d2b::pipeline {

/// Footprint on the grid of the DEM, with its measurements as far as they are done.
struct PlacedFootprint {
    enum class Place : std::uint8_t { inside, outside, without_cell, without_polygon };

    SpoolEntry feature;  ///< polygons in the CRS of the output, and the original
    SpoolEntry shape;    ///< valid polygons in the CRS of the DEM; of those inside only
    SpoolEntry cells;    ///< runs of cells with their centres in it
    std::int32_t first_row = 0;
    std::int32_t end_row = 0;
    Geodesy::Measure measure;
    Place place = Place::inside;
    bool at_edge = false;
    std::int64_t cell_count = 0;
    // From the units.
    std::int64_t elevated = 0;
    std::int64_t trees = 0;
    std::int64_t most_own_cells = 0;          ///< in the unit that gave the next two
    double ground = RoofElevations::unknown;  ///< in the vertical unit
    double shift_m = RoofElevations::unknown;
    // From its cells and contours.
    std::int64_t points = 0;
    double mean = RoofElevations::unknown;  ///< elevation
    RoofElevations roof;
    std::int64_t parts = 0;
    std::int32_t levels = 0;
    RoofRecord roof_shape;
};

/// Footprints that share no cell, as one label per cell.
struct FootprintLayer {
    detect::LabelRows labels;
    std::vector<std::size_t> footprints{0};  ///< index of the footprint by label; [0] is not used

    [[nodiscard]] Label count() const { return static_cast<Label>(footprints.size() - 1); }
};

/// Footprints of a run. Some 300 bytes per footprint are in memory, polygons and features in a spool.
struct GivenFootprints {
    std::vector<PlacedFootprint> all;  ///< in the order of the source
    /// Footprints that share no cells, in as few layers as possible, because a cell counts for each that
    /// covers it.
    std::vector<FootprintLayer> layers;
    std::unique_ptr<Spool> spool;
    Window window;

    /// Adds the statistics of a footprint in a unit. @param metres per vertical unit
    void add(std::size_t footprint, const detect::SeenFootprint& seen, double metres);
    /// Returns the labels of a layer in a part of the window.
    [[nodiscard]] Grid<Label> labels(std::size_t layer, const Window& part, Executor& threads) const;
    /// Returns the runs of its cells in the window, in scan order.
    [[nodiscard]] std::vector<RowSpan> cells(std::size_t footprint) const;
    /// Returns its valid polygons in the CRS of the DEM; none if it has no cell.
    [[nodiscard]] std::vector<WorldPolygon> shape(std::size_t footprint) const;
};

/// Reads footprints and finds their cells. Invalid ones are measured on a repaired copy; the first few are
/// named in a warning. @throws InputError, Cancelled
[[nodiscard]] GivenFootprints place_footprints(FootprintSource& source, const features::RunSetup& setup,
                                               Context& context);
/// Divides placed footprints into layers. @throws OutputError, Cancelled
void label_footprints(GivenFootprints& given, Context& context);

/// Returns the transform from coordinates to columns and rows. @pre not singular
[[nodiscard]] AffineTransform inverse_of(const AffineTransform& g);

}  // namespace d2b::pipeline
