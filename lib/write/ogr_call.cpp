#include "write/ogr_call.hpp"

#include <gdal_version.h>

#include "core/error.hpp"

namespace d2b {

void OgrCall::check(bool succeeded, const std::string& doing) {
    if (!succeeded || messages_.failed())
        fail(doing);
    pass_warnings();
}

void OgrCall::pass_warnings() {
    if (target_.context != nullptr)
        messages_.pass_warnings(*target_.context);
}

void OgrCall::fail(const std::string& doing) const {
    std::string text = reason();
    const std::string& hidden = target_.hidden_folder;
    // Nobody knows the hidden folder, and it is gone when the message is read.
    for (auto at = text.find(hidden); !hidden.empty() && at != std::string::npos; at = text.find(hidden, at))
        text.erase(at, hidden.size());
    throw OutputError("Cannot write \"" + target_.name + "\": " + doing + " failed (" + text + ").");
}

void close_written(const WriteTarget& target, DatasetHandle dataset) {
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

}  // namespace d2b
