#pragma once

#include <cstddef>
#include <cstdint>

namespace d2b {

/// How a DEM is read: in bands of rows, which are kept from one pass to the next where they fit.
struct BandSize {
    /// Of a band, in whole multiples of the usual block heights; more where blocks are higher. Some 4 MiB.
    std::int64_t points = 1 << 19;
    /// Most that is kept: 4 a point where that loses nothing, else 8.
    std::size_t keep_bytes = std::size_t{512} << 20;
};

}  // namespace d2b
