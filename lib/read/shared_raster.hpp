#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "read/band_reader.hpp"
#include "read/open_raster.hpp"

namespace d2b {

/// Open raster for one thread at a time, because a GDAL dataset is not thread-safe.
struct RasterReader {
    RasterReader(OpenRaster raster, const ReadOptions& options, const DemInfo& info, Warnings& warnings)
        : source(std::move(raster)), bands(source.band, options, info, warnings) {}
    OpenRaster source;
    BandReader bands;
};

/// Raster that several threads read concurrently.
class SharedRaster {
  public:
    SharedRaster() = default;
    SharedRaster(const SharedRaster&) = delete;
    SharedRaster& operator=(const SharedRaster&) = delete;
    virtual ~SharedRaster() = default;

    /// Same as BandReader::read().
    virtual void read(const Window& part, std::span<double> elevations) = 0;
};

/// Opens the implementation that suits the raster. @param path for opening it again, if that is faster for
/// several threads @param warnings outlives the result
/// @throws as BandReader
[[nodiscard]] std::unique_ptr<SharedRaster> share_raster(OpenRaster raster, const ReadOptions& options,
                                                         std::string path, const DemInfo& info,
                                                         Warnings& warnings);

}  // namespace d2b
