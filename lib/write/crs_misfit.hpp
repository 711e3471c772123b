#pragma once

#include <string>

#include <gdal.h>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// Reasons why a format does not preserve a CRS.
struct CrsMisfit {
    std::string lost{};     ///< reason why a layer loses its CRS or cannot be created; "" if it keeps it
    std::string read_as{};  ///< name of the CRS that programs will assume instead; "" if there is none
};

/// Tests in /vsimem/ if a layer of the format preserves a CRS, because some drivers reject a projection that
/// they have no name for, and others drop it or write the coordinates as if they were in the CRS of the
/// format. @param wkt "" for none @param place position in that CRS @return empty if the CRS is kept or the
/// coordinates are transformed to the CRS of the format
[[nodiscard]] CrsMisfit crs_misfit(GDALDriverH driver, const std::string& destination, const std::string& wkt,
                                   const Position& place);

}  // namespace d2b
