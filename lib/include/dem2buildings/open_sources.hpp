#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "dem2buildings/callbacks.hpp"
#include "dem2buildings/correction_source.hpp"
#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/footprint_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/parcel_source.hpp"

namespace d2b {

/// Opens a band of a raster, or of the mosaic of several. /vsistdin/ is copied to a temporary file first.
/// @throws InputError: cannot be opened, missing band, complex values, a singular transform, only GCPs, an
/// unusable cutline. @throws OptionError: options that do not fit the raster, or a window outside of it
[[nodiscard]] std::unique_ptr<DemSource> open_dem(const ReadOptions& options,
                                                  const Callbacks& callbacks = {});

enum class ValueType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Values in rows and columns, in memory owned by the caller. Strides are in bytes, of any size and sign.
struct StridedValues {
    const void* first = nullptr;  ///< value of row 0 and column 0; null if there are none
    std::ptrdiff_t row_step = 0;
    std::ptrdiff_t col_step = 0;
};

/// Raster in memory.
struct ElevationArray {
    std::string name;  ///< used in messages and provenance
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    ValueType type = ValueType::float64;
    StridedValues values;                      ///< may be unaligned
    StridedValues masked;                      ///< bytes, nonzero if a point is not valid; optional
    std::optional<AffineTransform> transform;  ///< required for a DEM
};

/// Opens an array as a DEM without copying it. NaN and infinite values are not valid. Windows, the cutline,
/// NoData and the CRS come from the options. @param array must not change while the source exists
/// @throws InputError: no cells, a singular transform, an unusable cutline. @throws OptionError: options of
/// files, or a window outside of the array
[[nodiscard]] std::unique_ptr<DemSource> open_dem(const ElevationArray& array, const ReadOptions& options,
                                                  const Callbacks& callbacks = {});

/// Additional inputs named by the options; empty if there are none.
struct AuxiliarySources {
    std::unique_ptr<DemSource> terrain;
    std::unique_ptr<DemSource> mask;
    std::unique_ptr<DemSource> ndvi;
    std::unique_ptr<ParcelSource> parcels;
    std::unique_ptr<FootprintSource> footprints;
    std::unique_ptr<DemSource> exclusion;
    std::unique_ptr<CorrectionSource> corrections;
};

/// Rasters in memory that replace those named by the options: one value per cell of the whole DEM, with its
/// transform and CRS. Elevations are in the DEM's vertical unit. They are copied.
struct AuxiliaryArrays {
    std::optional<ElevationArray> terrain;
    std::optional<ElevationArray> mask;
    std::optional<ElevationArray> ndvi;
};

/// Opens a terrain model, a mask, an NDVI, parcels, exclusions and corrections on the grid of the DEM, and
/// footprints. @throws InputError; OptionError, also if an array differs in size from the DEM
[[nodiscard]] AuxiliarySources open_auxiliary_sources(const Options& options, const DemInfo& dem,
                                                      const Callbacks& callbacks = {},
                                                      const AuxiliaryArrays& arrays = {});

}  // namespace d2b
