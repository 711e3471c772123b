#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/elevation_limits.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sources.hpp"

namespace d2b {

/// What accompanies a DEM, on its grid: sources with the rows, columns, window, transform and CRS of `grid`,
/// NaN where they know nothing. Of rasters the first band is taken, brought over by GDAL's warper where the
/// cells are not the same, a few rows at a time and with one thread; the same cells keep their values bit by
/// bit. A raster or DEM without a CRS is taken in the coordinates of the other, with a warning.
/// @throws InputError (all of them): cannot be opened or read, nothing in the window, a transform that is
/// singular or missing, no operation between the CRSs

/// A raster that accompanies a DEM: a file, or values in memory on the DEM's grid.
struct SideRaster {
    // One who has a name has all.
    SideRaster(std::string file) : path(std::move(file)) {}  // NOLINT(google-explicit-constructor)
    SideRaster(std::string name, const ElevationArray* values) : path(std::move(name)), array(values) {}

    std::string path;  ///< or the name of the array
    const ElevationArray* array = nullptr;
};

/// A window that was made around the terrain model, in another CRS, has gaps that mean nothing.
enum class TerrainGaps { warned_of, expected };

/// How a terrain model is read.
struct TerrainReading {
    TerrainGaps gaps = TerrainGaps::warned_of;  ///< whether the share of the window outside is warned of
    /// Whether values that seem to stand for no data without being declared (core/undeclared_values.hpp) are
    /// elevations.
    bool keeps_undeclared = false;
};

/// A terrain model. Elevations are in the vertical unit of the DEM, so that equal files give equal numbers:
/// those of another unit (the band's, else the vertical CRS's, else the DEM's own) are converted, vertical
/// datums are not, with a warning. Between centres of cells, values are interpolated linearly; finer terrain
/// models are averaged.
/// What lies outside of the limits is not valid, also where it would be resampled, and is counted
/// (DemSource::cells_outside_range); when all of the window has been read it is warned of.
/// @param dem_vertical_metres metres in one vertical unit of the DEM
/// @param limits of elevations, in the DEM's vertical unit
/// @throws InputError also when reading: more than half of the values are outside of the limits
[[nodiscard]] std::unique_ptr<DemSource> open_terrain(const SideRaster& raster, const DemInfo& grid,
                                                      double dem_vertical_metres,
                                                      const ElevationLimits& limits,
                                                      const Callbacks& callbacks = {},
                                                      const TerrainReading& reading = {});

/// Where to look: 1 inside, 0 outside, never NaN. Polygons, the centres of cells inside of any of which are
/// inside; or a raster, where all that is neither 0 nor invalid is inside, with the value of the cell in
/// which a centre lies. What is not covered is outside.
/// @param layer of the polygons; "" for the first that has geometries @throws OptionError: no such layer, or
/// a raster, which has none
[[nodiscard]] std::unique_ptr<DemSource> open_mask(const SideRaster& mask, const std::string& layer,
                                                   const DemInfo& grid, const Callbacks& callbacks = {});

/// The normalised difference vegetation index, resampled as terrain is. Scaled products (bytes, 16-bit
/// integers) are understood by scale and offset of the band. A value outside of [-1, 1] is refused when it is
/// read, and at once where one is in the middle row of the window.
[[nodiscard]] std::unique_ptr<DemSource> open_ndvi(const SideRaster& raster, const DemInfo& grid,
                                                   const Callbacks& callbacks = {});

}  // namespace d2b
