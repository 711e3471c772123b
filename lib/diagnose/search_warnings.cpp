#include "diagnose/search_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnose/ground_doubt.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/place_doubt.hpp"
#include "diagnose/sampling_doubt.hpp"
#include "diagnose/side_doubt.hpp"
#include "diagnose/warn_of.hpp"

namespace d2b {

void warn_of_search(const Search& search, bool found_any, Context& context) {
    const RunReport& report = context.report;
    if (report.valid_points == 0)
        return;
    warn_of(ndvi_doubt(search.sides, search.plan.asked), context);
    if (search.plan.ground == GroundMode::given) {
        const auto points = static_cast<double>(search.dem.window.points());
        const TerrainGap gap{
            report.valid_points, search.fit.cells(), std::llround(search.terrain_outside * points),
            std::max<std::int64_t>(cells_for(search.plan.building_m2, search.cell),
                                   std::int64_t{search.dem.window.rows} + search.dem.window.cols)};
        warn_of(terrain_gap_doubt(gap, search.dem.name, search.plan.asked.ground.terrain), context);
    }
    if (search.sampling)
        warn_of(rounding_doubt(*search.sampling, report.units.vertical_metres), context);
    const std::string ground = search_ground_doubt(search);
    const std::string doubt = ground.empty() ? surface_doubt(search.fit, search.dem.name) : ground;
    // A raster that is not a surface, or lies on another ground, has no walls that could be blurred.
    if (search.sampling && doubt.empty()) {
        const double side = std::sqrt(search.cell.area());
        warn_of(thin_doubt(*search.sampling, side), context);
        warn_of(blur_doubt(*search.sampling, side), context);
    }
    if (!found_any) {
        if (report.minimum != report.maximum)
            context.warn("No building was found: " + why_nothing_was_found(search) + ".");
        return;
    }
    if (search.dem.bytes && search.dem.bands >= 3)
        warn_of(picture_doubt(search.dem), context);
    if (search.parcels) {
        const DetectOptions& detect = search.plan.asked.detect;
        warn_of(misplaced_doubt(*search.parcels, search.cell, detect), context);
        warn_of(overlap_doubt(*search.parcels, detect), context);
        warn_of(validity_doubt(*search.parcels, detect), context);
    }
    warn_of(doubt, context);
}

}  // namespace d2b
