#include "pipeline/preview.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/units.hpp"
#include "options/side_files.hpp"

namespace d2b {

Crs crs_of(const Options& options, const DemInfo& dem) {
    return Crs(options.read.crs.empty() ? dem.crs_wkt : options.read.crs);
}

PreviewLook look_of(const Options& options, const DemInfo& dem, std::string heading) {
    PreviewLook look;
    look.heading = std::move(heading);
    look.vertical_metres =
        resolve_units(dem, crs_of(options, dem), options.read.vertical_unit).vertical_metres;
    return look;
}

RasterTarget picture_target(const Options& options) {
    const WriteOptions& write = options.write;
    RasterTarget target{write.preview, write.overwrite, {options.read.source}, RasterFormat::png};
    std::vector<std::string> others = side_rasters_of(write);
    others.insert(others.end(),
                  {write.destination, options.ground.terrain, options.detect.mask, options.detect.ndvi});
    for (const std::string& name : others)
        if (!name.empty())
            target.in_use.push_back(name);
    return target;
}

Preview::Preview(const Options& options, FeatureSink& features, DemSource& dem) : features_(features) {
    if (options.write.preview.empty())
        return;
    file_ = open_picture(picture_target(options));
    std::string heading = "lod " + std::to_string(options.levels.lod);
    if (!options.levels.fixed.empty() || options.levels.interval)
        heading = "given levels";
    heading += " nf " + std::to_string(options.filter.noise_factor);
    sink_.emplace(features, dem, crs_of(options, dem.info()), look_of(options, dem.info(), heading),
                  [this](const Image& image) { file_->write(image); });
}

void Preview::publish(const Callbacks& callbacks) {
    if (!file_)
        return;
    file_->publish();
    if (callbacks.on_warning)
        std::ranges::for_each(file_->take_warnings(), callbacks.on_warning);
}

}  // namespace d2b
