#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>

#include "read/band_reader.hpp"
#include "read/open_raster.hpp"

namespace d2b {

/// A raster that is open for one thread at a time, as GDAL's datasets are.
struct RasterReader {
    RasterReader(OpenRaster raster, const ReadOptions& options, const DemInfo& info, Warnings& warnings)
        : source(std::move(raster)), bands(source.band, options, info, warnings) {}
    OpenRaster source;
    BandReader bands;
};

/// A raster that several threads read at a time.
class SharedRaster {
  public:
    SharedRaster() = default;
    SharedRaster(const SharedRaster&) = delete;
    SharedRaster& operator=(const SharedRaster&) = delete;
    virtual ~SharedRaster() = default;

    /// As BandReader::read().
    virtual void read(const Window& part, std::span<double> elevations) = 0;
};

/// @param path to open it again, where several threads are quicker so @param warnings outlives what is made
/// @throws as BandReader does
[[nodiscard]] std::unique_ptr<SharedRaster> share_raster(OpenRaster raster, const ReadOptions& options,
                                                         std::string path, const DemInfo& info,
                                                         Warnings& warnings);

}  // namespace d2b
