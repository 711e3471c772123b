#include "read/start_gdal.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

namespace d2b {

void register_formats() {
    if (GDALGetDriverCount() == 0)
        GDALAllRegister();
}

void start_gdal() {
    // Messages of GDAL's worker threads, or from outside of our own scopes, go to the handler of the process.
    // This one says nothing but debug messages, which only appear where CPL_DEBUG asks for them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
    register_formats();
    // Rasters are read once, from the top to the bottom; GDAL would keep a twentieth of the machine's memory.
    constexpr GIntBig cache_bytes = GIntBig{128} << 20;
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr)
        GDALSetCacheMax64(cache_bytes);
}

}  // namespace d2b
