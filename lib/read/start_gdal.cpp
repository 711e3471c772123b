#include <cpl_error.h>
#include <gdal.h>

#include "read/gdal_dem_source.hpp"

namespace d2b {

void start_gdal() {
    // Messages of GDAL's worker threads, or from outside of our own scopes, go to the handler of the process.
    // This one says nothing but debug messages, which only appear where CPL_DEBUG asks for them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
    GDALAllRegister();
}

}  // namespace d2b
