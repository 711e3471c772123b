#pragma once

#include <cstdint>
#include <exception>

#include "core/warnings.hpp"
#include "read/band_reader.hpp"
#include "read/gdal_handles.hpp"

namespace d2b {

/// What a BandReader needs to be read as a dataset of GDAL's. Must outlive that dataset.
struct ValueSource {
    BandReader& reader;
    std::int32_t rows = 0;
    std::int32_t cols = 0;
    Warnings& warnings;
    std::exception_ptr failure;  ///< why reading has failed last: exceptions do not travel through GDAL
};

/// A dataset for GDAL's warper with one band of doubles: what a BandReader reads, with the same notion of
/// what is valid, NaN its NoData value. Without georeferencing.
[[nodiscard]] DatasetOwner value_dataset(ValueSource& source);

}  // namespace d2b
