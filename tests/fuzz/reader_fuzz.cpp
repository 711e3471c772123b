// A damaged file is read or refused with a sentence; nothing else happens.
#include <algorithm>
#include <array>
#include <cmath>

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "dem2buildings/open_sources.hpp"
#include "fuzz/bytes.hpp"
#include "read/gdal_setup.hpp"

namespace d2b::test {
namespace {

void start() {
    static const bool started = [] {
        // A virtual raster may name other files: none of a network.
        CPLSetConfigOption("CPL_CURL_ENABLE_VSIMEM", "NO");
        CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_EXTENSIONS", "none");
        CPLSetConfigOption("GDAL_HTTP_CONNECTTIMEOUT", "1");
        reading::start_gdal();
        return true;
    }();
    static_cast<void>(started);
}

void read_some(DemSource& source) {
    const Window& window = source.info().window;
    demand(window.rows > 0 && window.cols > 0, "a window has cells");
    const AffineTransform& g = source.info().transform;
    demand(std::isfinite(std::hypot(g[0], g[3])) && std::abs(g[1] * g[5] - g[2] * g[4]) > 0,
           "cells have a place and an area");
    demand(window.row >= 0 && window.row + std::int64_t{window.rows} <= source.info().rows, "it lies inside");
    const std::int32_t rows = std::min(window.rows, 8);
    if (std::int64_t{rows} * window.cols > 1 << 20)
        return;
    std::vector<double> elevations(static_cast<std::size_t>(rows) * static_cast<std::size_t>(window.cols));
    source.read({window.row, window.col, rows, window.cols}, elevations);
    source.read({window.end_row() - rows, window.col, rows, window.cols}, elevations);
    for (const double z : elevations)
        demand(z - z == 0 || z != z, "elevations are numbers or not known");
}

}  // namespace
}  // namespace d2b::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace d2b::test;
    start();
    Bytes bytes(data, size);
    static constexpr std::array drivers{"GTiff", "AAIGrid", "VRT"};
    d2b::ReadOptions options;
    options.source = "/vsimem/fuzzed";
    options.drivers = {drivers[bytes.below(drivers.size())]};
    std::string text = bytes.rest();
    VSIFCloseL(VSIFileFromMemBuffer(options.source.c_str(), reinterpret_cast<GByte*>(text.data()),
                                    text.size(), FALSE));
    try {
        read_some(*d2b::open_dem(options));
    } catch (const d2b::Error& error) {
        const std::string what = error.what();
        demand(!what.empty() && what.find('\n') == std::string::npos, "an error is a sentence");
    }
    VSIUnlink(options.source.c_str());
    return 0;
}
