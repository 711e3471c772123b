#include "diagnose/search_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "core/text.hpp"
#include "diagnose/coverage.hpp"
#include "diagnose/ground_fit.hpp"
#include "diagnose/parcel_fit.hpp"
#include "diagnose/warnings.hpp"

namespace d2b {
namespace {

/// Option that rejects objects, and their number.
struct Sieve {
    const char* option;
    double value;
    double standard;
    std::int64_t objects;
};

std::array<Sieve, 4> sieves(const SearchSummary& search) {
    const DetectOptions& detect = search.plan.asked.detect;
    const DetectOptions standard;
    const Tally& tally = search.tally;
    return {{{"-min_area", search.plan.building_m2, default_min_building_m2,
              tally.counted(Reason::building_small)},
             {"-min_height", detect.min_height, standard.min_height, tally.counted(Reason::building_low)},
             {"-min_building_height", detect.min_building_height, standard.min_building_height,
              tally.counted(Reason::building_not_tall)},
             {"-min_confidence", detect.min_confidence, standard.min_confidence,
              tally.counted(Reason::building_doubtful)}}};
}

/// @param stricter true: only options stricter than their defaults
std::string rejected_by(const SearchSummary& search, bool stricter) {
    std::string text;
    for (const Sieve& sieve : sieves(search))
        if (sieve.objects > 0 && (!stricter || sieve.value > sieve.standard))
            text += (text.empty() ? "" : ", ") + std::string(sieve.option) + " " + number_text(sieve.value) +
                    " leaves " + std::to_string(sieve.objects) + " out";
    return text.empty() ? text : text + "; a smaller value may show them";
}

}  // namespace

std::string search_ground_warning(const SearchSummary& search) {
    const GroundMode mode = search.plan.ground;
    if (std::string text = missing_ground_warning(search.islands, mode, search.dem.name); !text.empty())
        return text;
    // A raster with NoData as ground contains roofs alone, whose heights are those of buildings.
    if (mode == GroundMode::none && search.islands.narrow_most())
        return {};
    return ground_warning(search.fit, mode, search.plan.asked.ground.terrain);
}

std::string explain_empty_search(const SearchSummary& search) {
    const DemInfo& dem = search.dem;
    const DetectOptions& detect = search.plan.asked.detect;
    // The most frequent reason comes first.
    const std::array<std::function<std::string()>, 9> causes{
        [&] { return empty_auxiliary_warning(search.sides, search.plan.asked); },
        [&] { return picture_warning(dem); },
        [&] { return degrees_warning(dem, search.has_crs); },
        [&] {
            return extent_warning(dem.name, dem.window.cols * search.cell.across,
                                  dem.window.rows * search.cell.down * search.cell.sine);
        },
        [&] { return search_ground_warning(search); },
        [&] { return rejected_by(search, true); },
        [&] { return surface_warning(search.fit, dem.name); },
        [&] { return slope_warning(search.slope, dem.name); },
        [&] { return rejected_by(search, false); },
    };
    for (const auto& cause : causes)
        if (std::string text = cause(); !text.empty())
            return text;
    return "nothing that rises by more than " + number_text(detect.min_height) +
           " m above the ground is as smooth and wide as a roof; cells should be at most 1 m wide, or 2.5 m "
           "for large buildings, and -write_canopy shows everything that rises";
}

std::string explain_empty_result(const LevelPlan& plan, std::size_t buildings, const DemInfo& dem,
                                 const RunReport& report) {
    if (report.valid_points == 0)
        return "'" + report.input + "' has no valid point; the layers are empty";
    if (report.minimum == report.maximum && buildings == 0)
        return "all valid points of '" + report.input + "' have the same elevation; no building was found";
    if (plan.footprints || buildings > 0)
        return {};
    if (plan.level_count() == 1)
        return "no threshold lies between the lowest and the highest elevation; no building was found";
    if (const std::string picture = picture_warning(dem); !picture.empty())
        return "no building was found: " + picture;
    return "no building was found; a smaller -nf or -min_area, or more levels, may show some";
}

void warn_about_search(const SearchSummary& search, bool found_any, Context& context) {
    const RunReport& report = context.report;
    if (report.valid_points == 0)
        return;
    warn_unless_empty(ndvi_warning(search.sides, search.plan.asked), context);
    if (search.plan.ground == GroundMode::given) {
        const auto points = static_cast<double>(search.dem.window.points());
        const TerrainGap gap{
            report.valid_points, search.fit.cells(), std::llround(search.terrain_outside * points),
            std::max<std::int64_t>(cells_covering(search.plan.building_m2, search.cell),
                                   std::int64_t{search.dem.window.rows} + search.dem.window.cols)};
        warn_unless_empty(terrain_gap_warning(gap, search.dem.name, search.plan.asked.ground.terrain),
                          context);
    }
    if (search.sampling)
        warn_unless_empty(rounding_warning(*search.sampling, report.units.vertical_metres), context);
    const std::string ground = search_ground_warning(search);
    const std::string doubt = ground.empty() ? surface_warning(search.fit, search.dem.name) : ground;
    // A raster that is not a surface, or lies on another ground, has no walls that could be blurred.
    if (search.sampling && doubt.empty()) {
        const double side = std::sqrt(search.cell.area());
        warn_unless_empty(sparse_points_warning(*search.sampling, side), context);
        warn_unless_empty(blur_warning(*search.sampling, side), context);
    }
    if (!found_any) {
        if (report.minimum != report.maximum)
            context.warn("No building was found: " + explain_empty_search(search) + ".");
        return;
    }
    if (search.dem.bytes && search.dem.bands >= 3)
        warn_unless_empty(picture_warning(search.dem), context);
    if (search.parcels) {
        const DetectOptions& detect = search.plan.asked.detect;
        warn_unless_empty(misplaced_warning(*search.parcels, search.cell, detect), context);
        warn_unless_empty(overlap_warning(*search.parcels, detect), context);
        warn_unless_empty(validity_warning(*search.parcels, detect), context);
    }
    warn_unless_empty(doubt, context);
}

}  // namespace d2b
