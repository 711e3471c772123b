#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/invalid_elevations.hpp"
#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/open_sources.hpp"

namespace d2b::reading {

/// Rasters that accompany a DEM, on its grid: sources with the rows, columns, window, transform and CRS of
/// `grid`, and NaN for cells without data. The first band of a raster is read. If its cells differ from those
/// of the DEM, GDAL's warper resamples it, a few rows at a time in one thread; otherwise values are identical
/// bit by bit. A raster or DEM without a CRS is taken to be in that of the other, with a warning.
/// @throws InputError (all of them): cannot be opened or read, nothing in the window, a transform that is
/// singular or missing, no operation between the CRSs

/// Raster that accompanies a DEM: a file, or values in memory on the DEM's grid.
struct AuxiliaryRaster {
    // Implicit, so that a file name suffices.
    AuxiliaryRaster(std::string file) : path(std::move(file)) {}  // NOLINT(google-explicit-constructor)
    AuxiliaryRaster(std::string name, const ElevationArray* values) : path(std::move(name)), array(values) {}

    std::string path;  ///< name of the array if there is one
    const ElevationArray* array = nullptr;
};

/// Handling of gaps in the terrain. A window derived from the terrain model, in another CRS, has gaps that
/// are of no concern.
enum class TerrainGaps { reported, expected };

/// Options for reading a terrain model.
struct TerrainReadOptions {
    TerrainGaps gaps = TerrainGaps::reported;  ///< decides if a share of the window outside is reported
    /// Keeps values that seem to stand for NoData without being declared (core/undeclared_nodata.hpp) as
    /// elevations.
    bool keeps_undeclared = false;
};

/// Opens a terrain model. Elevations are in the vertical unit of the DEM, so that equal files give equal
/// numbers: other units (of the band, else of the vertical CRS, else the DEM's own) are converted. Differing
/// vertical datums are not converted but reported. Values are interpolated linearly between cell centres;
/// finer terrain models are averaged. Elevations outside of `limits` are excluded before resampling and
/// counted (DemSource::cells_outside_range); once the whole window has been read, a warning gives their
/// number.
/// @param dem_vertical_metres metres per vertical unit of the DEM
/// @param limits of elevations, in the vertical unit of the DEM
/// @throws InputError also when reading: more than half of the values are outside of the limits
[[nodiscard]] std::unique_ptr<DemSource> open_terrain(const AuxiliaryRaster& raster, const DemInfo& grid,
                                                      double dem_vertical_metres,
                                                      const ElevationLimits& limits,
                                                      const Callbacks& callbacks = {},
                                                      const TerrainReadOptions& reading = {});

/// Opens the mask of the search area: 1 inside, 0 outside, never NaN. It is either polygons, which contain
/// the centres of cells inside, or a raster, whose values that are neither 0 nor invalid are inside (nearest
/// neighbour). Cells that it does not cover are outside.
/// @param layer of the polygons; "" for the first one with geometries @throws OptionError: no such layer, or
/// the mask is a raster, which has none
[[nodiscard]] std::unique_ptr<DemSource> open_mask(const AuxiliaryRaster& mask, const std::string& layer,
                                                   const DemInfo& grid, const Callbacks& callbacks = {});

/// Polygons of objects that are not buildings.
struct ExclusionChoice {
    std::string dataset;  ///< anything with polygons that GDAL opens
    std::string layer;    ///< "": first layer with geometries, with a warning if there are several
    double buffer_m = 0;  ///< the polygons are widened by this
};

/// Opens polygons of objects that are not buildings: 1 in cells whose centres they contain, otherwise 0.
/// Warns if none of them is in the window, because one dataset may serve many rasters.
/// @throws InputError also without polygons. @throws OptionError: no such layer
[[nodiscard]] std::unique_ptr<DemSource> open_exclusion(const ExclusionChoice& choice, const DemInfo& grid,
                                                        const Callbacks& callbacks = {});

/// Opens the normalised difference vegetation index, resampled like terrain. Scaled products (bytes, 16-bit
/// integers) are read with the scale and offset of the band. Values outside of [-1, 1] are rejected when they
/// are read; the middle row of the window is checked at once.
[[nodiscard]] std::unique_ptr<DemSource> open_ndvi(const AuxiliaryRaster& raster, const DemInfo& grid,
                                                   const Callbacks& callbacks = {});

}  // namespace d2b::reading
