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
    // Messages of GDAL's worker threads, or outside of our own scopes, go to the handler of the process. This
    // one drops everything except debug messages, which appear only if CPL_DEBUG asks for them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
    register_formats();
    // Limits the cache, because rasters are read once from top to bottom and GDAL would keep a twentieth of
    // the machine's memory.
    constexpr GIntBig cache_bytes = GIntBig{128} << 20;
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr)
        GDALSetCacheMax64(cache_bytes);
}

}  // namespace d2b
