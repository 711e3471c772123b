#include "core/crs.hpp"
#include "dem2buildings/version.hpp"
#include "geometry/geos.hpp"
#include "read/gdal_command_line.hpp"

namespace d2b {

std::string library_versions() {
    return "GDAL " + gdal_version() + ", GEOS " + geos_version() + ", PROJ " + proj_version() +
           ", GeographicLib " + geographiclib_version();
}

}  // namespace d2b
