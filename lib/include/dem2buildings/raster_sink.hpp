#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace d2b {

/// Where a raster goes that lies on the DEM's window: a file (write/), or an array in tests and in other
/// programs. Rows in order, then finish, from the thread that called run(). A sink that is destroyed without
/// finish() leaves the destination as it was.
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

    /// What it has noticed since the last call, a sentence each, for the run to warn of.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b
