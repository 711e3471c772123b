#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace d2b {

/// Where a raster goes that lies on the DEM's window: a file (write/), or an array in tests and in other
/// programs. Rows in order, then finish. A sink that is destroyed without finish() leaves the destination as
/// it was.
class RasterSink {
  public:
    RasterSink() = default;
    RasterSink(const RasterSink&) = delete;
    RasterSink& operator=(const RasterSink&) = delete;
    virtual ~RasterSink() = default;

    /// @param values whole rows, NaN where there is no value @throws OutputError
    virtual void write(std::int32_t rows, std::span<const float> values) = 0;
    /// Makes the raster visible, all of it or nothing. @throws OutputError
    virtual void finish() = 0;
};

}  // namespace d2b
