#include "read/start_gdal.hpp"

#include <cstdarg>
#include <dlfcn.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

namespace d2b {
namespace {

/// Keeps libtiff's global handler from printing, because GDAL 3.10 reports failed reads and writes through
/// handlers of its own and leaves lines such as "_tiffWriteProc: No space left on device." to the global one.
/// Looked up at run time, because GDAL may have been built with a libtiff of its own.
void silence_libtiff() {
    using Handler = void (*)(const char*, const char*, va_list);
    using SetHandler = Handler (*)(Handler);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): dlsym() returns functions as data
    if (const auto set = reinterpret_cast<SetHandler>(dlsym(RTLD_DEFAULT, "TIFFSetErrorHandler")))
        set(nullptr);
}

}  // namespace

void register_formats() {
    if (GDALGetDriverCount() == 0)
        GDALAllRegister();
}

void start_gdal() {
    // Messages of GDAL's worker threads, or outside of our own scopes, go to the handler of the process. This
    // one drops everything except debug messages, which appear only if CPL_DEBUG asks for them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
    register_formats();
    silence_libtiff();
    // Limits the cache, because rasters are read once from top to bottom and GDAL would keep a twentieth of
    // the machine's memory.
    constexpr GIntBig cache_bytes = GIntBig{128} << 20;
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr)
        GDALSetCacheMax64(cache_bytes);
}

}  // namespace d2b
