#include "view/preview.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/georeference.hpp"
#include "dem2buildings/error.hpp"
#include "options/run_plan.hpp"
#include "read/source_place.hpp"
#include "view/map_page.hpp"

namespace d2b::view {
namespace {

CellSize cell_of(const DemInfo& dem, const Crs& crs) {
    try {
        return cell_steps(dem.window, Georeference(dem.transform, TraceMode::cells), crs);
    } catch (const InputError&) {
        // The centre lies outside the projection's domain, which is allowed when levels are traced without
        // detection.
        const AffineTransform& g = dem.transform;
        const double metres = crs.horizontal_unit() ? crs.horizontal_unit()->metres : 1;
        return {std::hypot(g[1], g[4]) * metres, std::hypot(g[2], g[5]) * metres, 1};
    }
}

PageLayout layout_of(const WriteOptions& write, const MapArea& area, writing::PictureFormat format,
                     const PageWords& words) {
    if (!write.preview_paper)
        return plan_page(area, write.preview_size, words);
    return plan_paper(area, {*write.preview_paper, write.landscape, write.preview_scale}, format, words);
}

}  // namespace

MapArea map_area_of(const Options& options, const DemInfo& dem) {
    const Crs crs(options.read.crs.empty() ? dem.crs_wkt : options.read.crs);
    return {dem, crs, cell_of(dem, crs)};
}

writing::FileTarget picture_target(const Options& options) {
    const WriteOptions& write = options.write;
    writing::FileTarget target{
        write.preview, write.overwrite, {options.read.source}, writing::FileKind::picture};
    std::vector<std::string> others = auxiliary_file_names(write);
    std::ranges::copy(reading::rasters_of(options.read.source), std::back_inserter(others));
    others.insert(others.end(),
                  {write.destination, options.ground.terrain, options.detect.mask, options.detect.exclude,
                   options.detect.corrections, options.detect.ndvi, options.detect.split_by});
    for (const std::string& name : others)
        if (!name.empty())
            target.in_use.push_back(name);
    return target;
}

Preview::Preview(const Options& options, FeatureSink& features, const DemInfo& dem) : features_(features) {
    if (options.write.preview.empty())
        return;
    file_.emplace(writing::resolve_file_target(picture_target(options)));
    const MapArea ground = map_area_of(options, dem);
    const writing::PictureFormat format = *writing::picture_format_of(options.write.preview);
    const PageWords words = page_words(options);
    const PageLayout layout = layout_of(options.write, ground, format, words);
    sink_.emplace(features, MapFrame(ground, layout.map), format,
                  [this, format, layout, words](const MapPicture& map) {
                      file_->write(draw_map_page(map, format, layout, words));
                  });
}

void Preview::prepare(CommitList& commit) {
    if (file_)
        file_->prepare(commit);
}

std::vector<std::string> Preview::take_warnings() {
    return file_ ? file_->take_warnings() : std::vector<std::string>();
}

}  // namespace d2b::view
