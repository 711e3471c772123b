#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// Opens a band of any raster that GDAL reads as a DEM. /vsistdin/ is kept in a temporary file first.
/// @throws InputError: cannot be opened, no such band, complex values, a singular transform, GCPs only, an
/// unusable cutline. @throws OptionError: options that do not fit the raster, or a window outside of it
[[nodiscard]] std::unique_ptr<DemSource> open_dem(const ReadOptions& options,
                                                  const Callbacks& callbacks = {});

enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Values in rows and columns, in memory that belongs to the caller. Steps are in bytes, of any size and
/// sign.
struct StridedValues {
    const void* first = nullptr;  ///< of row 0 and column 0; null: there are none
    std::ptrdiff_t row_step = 0;
    std::ptrdiff_t col_step = 0;
};

/// A raster in memory.
struct ElevationArray {
    std::string name;  ///< for messages and provenance
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    ValueType type = ValueType::float64;
    StridedValues values;                      ///< need not be aligned
    StridedValues masked;                      ///< bytes, not 0 where a point is not valid; there may be none
    std::optional<AffineTransform> transform;  ///< of a DEM
};

/// The array as a DEM: nothing of it is copied. NaN and infinite values are not valid. Windows, the cutline,
/// NoData and the CRS are those of the options.
/// @param array which must not change as long as the source lives
/// @throws InputError: no cells, a singular transform, an unusable cutline. @throws OptionError: options of
/// files, or a window outside of the array
[[nodiscard]] std::unique_ptr<DemSource> open_dem(const ElevationArray& array, const ReadOptions& options,
                                                  const Callbacks& callbacks = {});

/// What the options name beside the DEM; empty where they name nothing.
struct SideSources {
    std::unique_ptr<DemSource> terrain;
    std::unique_ptr<DemSource> mask;
    std::unique_ptr<DemSource> ndvi;
    std::unique_ptr<ParcelSource> parcels;
};

/// Rasters in memory that stand for those that the options name: one value per cell of the whole DEM, whose
/// transform and CRS they have. Elevations are in the DEM's vertical unit. They are copied.
struct SideArrays {
    std::optional<ElevationArray> terrain;
    std::optional<ElevationArray> mask;
    std::optional<ElevationArray> ndvi;
};

/// A terrain model, a mask, an NDVI and parcels, on the grid of the DEM. @throws InputError; OptionError,
/// also where an array has not the rows and columns of the DEM
[[nodiscard]] SideSources open_side_sources(const Options& options, const DemInfo& dem,
                                            const Callbacks& callbacks = {}, const SideArrays& arrays = {});

}  // namespace d2b
