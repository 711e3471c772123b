#include "write/ogr_util.hpp"

#include <gdal_version.h>

#include "dem2buildings/error.hpp"
#include "write/io_error_monitor.hpp"

namespace d2b::writing {

std::string advice_for(const std::string& reason) {
    if (reason.find("database is locked") != std::string::npos)
        return "; another program is using it: close it there (in QGIS end editing and remove its layers), "
               "then "
               "run again";
    if (reason.find("readonly database") != std::string::npos)
        return "; it is read-only: allow writing, or choose another destination";
    return "";
}

void OgrCall::check(bool succeeded, const std::string& doing) {
    if (target_.monitor != nullptr)
        target_.monitor->require_written(target_.name);
    if (!succeeded || messages_.failed())
        fail(doing);
    pass_warnings();
}

void OgrCall::pass_warnings() {
    if (target_.warnings != nullptr)
        messages_.pass_warnings(*target_.warnings);
}

void OgrCall::fail(const std::string& doing) const {
    const std::string text = reason();
    throw OutputError("Cannot write \"" + target_.name + "\": " + doing + " failed (" + text + ")" +
                      advice_for(text) + ".");
}

void close_written(const WriteTarget& target, reading::DatasetOwner dataset) {
    OgrCall call(target);
    GDALFlushCache(dataset.get());
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0)
    const bool closed = GDALClose(dataset.release()) == CE_None;
#else
    const bool closed = true;
    dataset.reset();
#endif
    call.check(closed, "closing the dataset");
}

}  // namespace d2b::writing
