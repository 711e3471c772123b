#include "write/staged_raster.hpp"

#include <utility>

#include <cpl_vsi.h>

#include "dem2buildings/error.hpp"
#include "write/existing_dataset.hpp"

namespace d2b {

StagedRaster::StagedRaster(RasterPlace place)
    : place_(std::move(place)), target_{.name = place_.name, .hidden_folder = "", .warnings = &warnings_} {
    warnings_.hold();
}

StagedRaster::~StagedRaster() {
    const GdalMessages quiet;
    if (!beside_.empty())
        VSIUnlink(beside_.c_str());
}

std::string StagedRaster::begin() {
    if (!place_.local)
        return beside_ = place_.path + ".part";
    staging_.emplace(place_.name, place_.path);
    target_.hidden_folder = staging_->folder().string() + "/";
    return staging_->dataset().string();
}

void StagedRaster::publish(const std::string& renaming) {
    if (!staging_) {
        OgrCall call(target_);
        if (!place_.old_files.empty())
            VSIUnlink(place_.path.c_str());
        call.check(VSIRename(beside_.c_str(), place_.path.c_str()) == 0, renaming);
        beside_.clear();
        return;
    }
    staging_->seal();
    staging_->sync();
    if (stamp_of(place_.old_files) != place_.stamp)
        throw OutputError("\"" + place_.name +
                          "\" has changed while this run was going on and is left alone; run again.");
    static_cast<void>(staging_->publish(place_.old_files));
    staging_.reset();
}

}  // namespace d2b
