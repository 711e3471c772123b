#pragma once

#include <string>

#include <gdal.h>

#include "dem2buildings/sinks.hpp"

namespace d2b {

/// What becomes of a CRS in a format.
struct CrsMisfit {
    std::string lost{};     ///< why a layer has none, or cannot be made; "" where it has one
    std::string read_as{};  ///< name of another one that programs will take it for; "" where none will
};

/// Whether a layer of the format gives a CRS back, by a trial in /vsimem/: some drivers refuse a projection
/// that they have no name for, others drop it, or write the coordinates as if they were of the format's own.
/// @param wkt "" for none @param place a position in it
/// @return nothing where it is kept, or the coordinates are brought to the format's own
[[nodiscard]] CrsMisfit crs_misfit(GDALDriverH driver, const std::string& destination, const std::string& wkt,
                                   const Position& place);

}  // namespace d2b
