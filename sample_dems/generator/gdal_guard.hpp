#pragma once

#include <memory>
#include <string>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "dem2buildings/error.hpp"

namespace d2b::sample {

/// GDAL's messages go into exceptions, not to the terminal, while this lives.
class QuietGdal {
  public:
    QuietGdal() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
    }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;
    ~QuietGdal() { CPLPopErrorHandler(); }

    /// @throws OutputError with GDAL's reason
    static void require(bool done, const std::string& path) {
        if (!done)
            throw OutputError("Cannot write " + path + ": " + CPLGetLastErrorMsg() +
                              "; check that the folder exists, can be written and has space.");
    }
};

/// Closes without a word; call close() where errors matter.
struct DatasetCloser {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;

/// Writes the data still in memory by closing. GDAL 3.6 returns nothing from it, but leaves its error.
inline void close(Dataset dataset, const std::string& path) {
    CPLErrorReset();
    dataset.reset();
    QuietGdal::require(CPLGetLastErrorType() < CE_Failure, path);
}

/// Axes in GIS order. @throws OutputError
inline OGRSpatialReference spatial_reference(const std::string& crs, const std::string& path) {
    OGRSpatialReference reference;
    if (reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE)
        throw OutputError("Cannot write " + path + ": there is no CRS " + crs +
                          "; give one that PROJ knows.");
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

}  // namespace d2b::sample
