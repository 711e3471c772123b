#pragma once

#include <string>

#include <gdal.h>

#include "core/feature_sink.hpp"

namespace d2b {

/// Whether a layer of the format gives a CRS back, by a trial in /vsimem/: some drivers refuse a projection
/// that they have no name for, others drop it. @param wkt "" for none @param place a position in it
/// @return what becomes of it; "" where it is kept, or the coordinates are brought to the format's own
[[nodiscard]] std::string crs_misfit(GDALDriverH driver, const std::string& destination,
                                     const std::string& wkt, const Position& place);

}  // namespace d2b
