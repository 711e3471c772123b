#pragma once

#include <cstdint>
#include <exception>

#include "core/warnings.hpp"
#include "read/band_reader.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// Data of a ValueDataset. Must outlive that dataset.
struct ValueSource {
    BandReader& reader;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    Warnings& warnings;
    std::exception_ptr failure;  ///< last failure, because exceptions must not pass through GDAL
};

/// Wraps a BandReader as a dataset for GDAL's warper: one band of doubles with the same validity rules, NaN
/// as NoData, and no georeferencing.
[[nodiscard]] DatasetOwner value_dataset(ValueSource& source);

}  // namespace d2b
