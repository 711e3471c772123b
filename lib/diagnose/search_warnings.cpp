#include "diagnose/search_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.hpp"
#include "diagnose/warnings.hpp"

namespace d2b::diagnose {
namespace {

/// Minimum number of pieces, because one or two may be a small cut-out of a surface.
constexpr std::int64_t fewest_islands = 3;

constexpr int picture_bands = 3;
constexpr double fewest_bare = 0.05;
constexpr double farthest_m = 2;
constexpr double fewest_raised = 0.001;

std::string within(const detect::GroundFit& fit) {
    return "only " + percent(fit.bare_share()) + " of the cells lie within " + number_text(fit.min_height()) +
           " m of ";
}

std::string doubt_of_given(const detect::GroundFit& fit, const std::string& terrain, bool few) {
    const std::string see = "; check whether both have the same unit and vertical datum";
    if (few)
        return within(fit) + "the terrain '" + terrain + "', above which the surface lies " +
               rounded(fit.median()) + " m (median)" + see;
    const double median = fit.bare_median();
    return "the terrain '" + terrain + "' lies " + rounded(std::abs(median)) + " m " +
           (median < 0 ? "above" : "below") + " the surface where nothing stands on it (median)" + see;
}

/// Begins a warning of elevations that -ground none takes as heights.
std::string taken_as_heights(double median) {
    return "-ground none takes elevations as heights above the ground, and their median is " +
           rounded(median) + " m";
}

constexpr double least_length_m = 150;   // length of cuts next to walls: a street has less by chance
constexpr double least_share = 1.0 / 3;  // share of all cuts: walls next to fewer of them are chance
// Limits if no move stands out. Parcels of Delft have 0.5 m; the same parcels moved by 2 or 3 m have 1.5 m,
// because blocks are full of walls.
constexpr double usual_m = 1.25;
constexpr double usual_cells = 1.6;
constexpr double usual_overlap = 0.01;

/// "3 m to the left and 1.5 m down"
std::string told(const ParcelMove& move) {
    std::string text;
    const auto add = [&](double metres, const char* more, const char* less) {
        if (metres != 0)
            text += (text.empty() ? "" : " and ") + rounded(std::abs(metres)) + " m " +
                    (metres > 0 ? more : less);
    };
    add(move.right_m, "to the right", "to the left");
    add(move.down_m, "down", "up");
    return text;
}

std::string displaced_doubt(const ParcelMove& move, double usual, const DetectOptions& options) {
    const double length = std::hypot(move.right_m, move.down_m);
    if (!(length > usual))
        return {};
    return "parcels of '" + options.split_by + "' lie " + rounded(length) +
           " m off the walls as a whole: they fit best if they are moved " + told(move) +
           " on the raster; compare them with the buildings, and move them if that is right";
}

/// @return "" unless -exclude leaves out more buildings than remain
std::string exclusion_warning(const SearchSummary& search) {
    const std::int64_t excluded = search.tally.counted(Reason::building_excluded);
    const auto kept = static_cast<std::int64_t>(search.buildings);
    if (excluded <= kept)
        return {};
    return "-exclude '" + search.plan.asked.detect.exclude + "' leaves out " + std::to_string(excluded) +
           " of " + std::to_string(excluded + kept) +
           " buildings that were found; check that its polygons are bridges, water and the like";
}

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

using Search = const SearchSummary&;
using Report = const RunReport&;

/// Reason why the ground of a search cannot be right, or only buildings have elevations.
std::string search_ground_warning(Search search) {
    const GroundMode mode = search.plan.ground;
    const detect::ValidIslands& islands = search.scene.islands;
    if (std::string text = missing_ground_warning(islands, mode, search.dem.name); !text.empty())
        return text;
    // A raster with NoData as ground contains roofs alone, whose heights are those of buildings.
    constexpr double tall_m = 20;
    constexpr double nearly_all = 0.95;
    const detect::GroundFit& fit = search.scene.fit;
    const bool roofs_alone = mode != GroundMode::automatic && islands.narrow_most();
    if (roofs_alone && fit.median() > 0 && fit.share_above(tall_m) < nearly_all)
        return {};
    if (roofs_alone && mode == GroundMode::none)
        return taken_as_heights(fit.median()) + ", with NoData around; give a terrain model with -ground";
    return ground_warning(fit, mode, search.plan.asked.ground.terrain);
}

std::string flat_surface_warning(Search search) {
    const Window& window = search.dem.window;
    const double width = search.plan.asked.ground.max_building_width;
    const bool holds_wider =
        search.plan.ground == GroundMode::automatic &&
        std::min(window.cols * search.cell.across, window.rows * search.cell.down * search.cell.sine) > width;
    return surface_warning(search.scene.fit, search.dem.name,
                           holds_wider ? std::optional(width) : std::nullopt);
}

/// Reason why the raster may not be a surface, or the ground may not be its ground.
std::string surface_doubt(Search search) {
    const std::string ground = search_ground_warning(search);
    return ground.empty() ? flat_surface_warning(search) : ground;
}

/// Warns of a picture, unless its only band has pieces with NoData around them, as heights in whole metres
/// do.
std::string picture_doubt(Search search) {
    const bool pieces =
        !missing_ground_warning(search.scene.islands, search.plan.ground, search.dem.name).empty();
    return pieces && search.dem.bands < picture_bands ? std::string() : picture_warning(search.dem);
}

/// Returns true if objects were found in a picture or a hillshade: three bands of bytes, or bands or
/// bytes far above the ground that was estimated, because that is their shadows. Lights of a hillshade also
/// rise by more than a building above all cells around them. One band of bytes above a plausible ground is
/// elevations in whole metres.
bool looks_like_picture(Search search, Report report) {
    constexpr std::int64_t fewest_lights = 2;  // one may be a fault of elevations
    const DemInfo& dem = search.dem;
    if (picture_doubt(search).empty())
        return false;
    const bool shadows =
        search.plan.ground == GroundMode::automatic && !search_ground_warning(search).empty();
    const bool lights = dem.bytes && report.counted(Reason::elevation_spike) >= fewest_lights;
    return (dem.bytes && dem.bands >= picture_bands) || shadows || lights;
}

/// Share of cells without ground, if they exceed the part outside of the terrain model, of which its source
/// has warned, and are not all. Threshold: the cells of a building, or half of the window's border, because
/// resampling a terrain loses cells there.
std::string terrain_gap_warning(Search search, Report report) {
    const Window& window = search.dem.window;
    const std::int64_t known = search.scene.fit.cells();
    const std::int64_t missing = report.valid_points - known;
    const std::int64_t fewest =
        std::max<std::int64_t>(detect::cells_covering(search.plan.building_m2, search.cell),
                               std::int64_t{window.rows} + window.cols);
    const auto outside = std::llround(search.terrain_outside * static_cast<double>(window.points()));
    // The share outside is measured on a lattice of points.
    if (search.plan.ground != GroundMode::given || known == 0 || missing < fewest ||
        missing <= outside + outside / 50)
        return {};
    return percent(static_cast<double>(missing) / static_cast<double>(report.valid_points)) +
           " of the cells of '" + search.dem.name + "' that have an elevation have none in the terrain '" +
           search.plan.asked.ground.terrain +
           "'; there is no ground there, and buildings are cut off or missing, so fill its NoData, for "
           "example with gdal_fillnodata.py, or leave -ground out to have the ground estimated";
}

double side_of(Search search) {
    return std::sqrt(search.cell.area());
}

/// Reasons why nothing was found, the most frequent first.
constexpr std::array<std::string (*)(Search), 10> empty_search_reasons{
    [](Search s) { return empty_auxiliary_warning(s.scene.sides, s.plan.asked); },
    picture_doubt,
    [](Search s) { return degrees_warning(s.dem, s.has_crs); },
    [](Search s) {
        return extent_warning(s.dem.name, s.dem.window.cols * s.cell.across,
                              s.dem.window.rows * s.cell.down * s.cell.sine);
    },
    search_ground_warning,
    [](Search s) { return exclusion_warning(s); },
    [](Search s) { return rejected_by(s, true); },
    flat_surface_warning,
    [](Search s) { return slope_warning(s.scene.slope, s.dem.name); },
    [](Search s) { return rejected_by(s, false); },
};

enum class When {
    always,
    plausible_surface,  ///< other rasters have no walls that could be blurred
    found,              ///< buildings were found
};

struct SearchWarning {
    When when;
    std::string (*text)(Search, Report);
};

/// Warnings about a search in the order in which they are issued. A report without sampling or parcels has
/// nothing to warn of.
constexpr std::array<SearchWarning, 11> search_warnings{{
    {When::always, [](Search s, Report) { return ndvi_warning(s.scene.sides, s.plan.asked); }},
    {When::always, terrain_gap_warning},
    {When::always,
     [](Search, Report r) {
         return r.sampling ? rounding_warning(*r.sampling, r.units.vertical_metres) : std::string();
     }},
    {When::plausible_surface,
     [](Search s, Report r) {
         return r.sampling ? sparse_points_warning(*r.sampling, side_of(s)) : std::string();
     }},
    {When::plausible_surface,
     [](Search s, Report r) { return r.sampling ? blur_warning(*r.sampling, side_of(s)) : std::string(); }},
    {When::found,
     [](Search s, Report r) { return looks_like_picture(s, r) ? picture_warning(s.dem) : std::string(); }},
    {When::found, [](Search s, Report) { return exclusion_warning(s); }},
    {When::found,
     [](Search s, Report r) {
         return r.parcels ? misplaced_warning(*r.parcels, s.cell, s.plan.asked.detect) : std::string();
     }},
    {When::found,
     [](Search s, Report r) {
         return r.parcels ? overlap_warning(*r.parcels, s.plan.asked.detect) : std::string();
     }},
    {When::found,
     [](Search s, Report r) {
         return r.parcels ? validity_warning(*r.parcels, s.plan.asked.detect) : std::string();
     }},
    {When::found,
     [](Search s, Report r) { return looks_like_picture(s, r) ? std::string() : surface_doubt(s); }},
}};

}  // namespace

std::string missing_ground_warning(const detect::ValidIslands& islands, GroundMode mode,
                                   const std::string& dem) {
    if (mode != GroundMode::automatic || !islands.narrow_most() || islands.islands < fewest_islands ||
        2 * islands.largest > islands.cells)
        return {};
    return "'" + dem + "' has elevations in " + std::to_string(islands.islands) +
           " pieces as wide as buildings and NoData around them, so roofs are taken for the ground; give "
           "-ground none if its values are heights above ground, or a terrain model with -ground if they are "
           "elevations";
}

std::string empty_auxiliary_warning(const detect::AuxiliaryCoverage& known, const Options& options) {
    if (!known.terrain)
        return "the terrain '" + options.ground.terrain +
               "' has no valid cell over the DEM; give one of the same place with -ground, or leave -ground "
               "out to have the ground estimated";
    if (!known.mask)
        return "the mask '" + options.detect.mask +
               "' has no cell over the DEM that is neither 0 nor NoData; give one with -mask that marks "
               "where buildings may be";
    return {};
}

std::string ndvi_warning(const detect::AuxiliaryCoverage& known, const Options& options) {
    if (known.ndvi)
        return {};
    return "the NDVI '" + options.detect.ndvi +
           "' has no valid cell over the DEM, so it shows no plants; give one of the same place with -ndvi";
}

std::string slope_warning(const detect::GroundSlope& slope, const std::string& dem) {
    if (2 * slope.steep_cells <= slope.cells)
        return {};
    const double share = static_cast<double>(slope.steep_cells) / static_cast<double>(slope.cells);
    return percent(share) + " of the ground of '" + dem + "' is steeper than " +
           percent(detect::GroundSlope::steep) +
           ", where buildings can hardly be told from the slope; give a terrain model with -ground, and "
           "check the units of elevations and coordinates (-zunit)";
}

std::string ground_warning(const detect::GroundFit& fit, GroundMode mode, const std::string& terrain) {
    const bool few = fit.bare_share() < fewest_bare;
    if (fit.cells() == 0 || (!few && !(std::abs(fit.bare_median()) > farthest_m)))
        return {};
    if (mode == GroundMode::given)
        return doubt_of_given(fit, terrain, few);
    if (mode == GroundMode::none)
        return taken_as_heights(few ? fit.median() : fit.bare_median()) + (few ? "" : " where they are low") +
               "; give a terrain model with -ground, or leave -ground out to have the ground estimated";
    return within(fit) + "the ground that was estimated" +
           (few ? "" : ", and these " + rounded(fit.bare_median()) + " m above it (median)") +
           "; give a terrain model with -ground, or use a larger part of the raster";
}

std::string surface_warning(const detect::GroundFit& fit, const std::string& dem,
                            std::optional<double> max_building_width) {
    const double usual = DetectOptions{}.min_height;
    const double share = fit.share_above(usual);
    if (fit.cells() == 0 || share >= fewest_raised)
        return {};
    return (share > 0 ? percent(share) : "none") + " of the cells of '" + dem + "' rise by more than " +
           number_text(usual) +
           " m above their surroundings, as in a terrain model (DTM), which has no buildings; give the "
           "surface model (DSM)" +
           (max_building_width ? ", or a larger -max_building_width if a building is wider than " +
                                     number_text(*max_building_width) + " m"
                               : "");
}

std::string misplaced_warning(const ParcelReport& report, const CellSize& cell,
                              const DetectOptions& options) {
    if (report.inside_m2 == 0 && report.cut_length_m == 0)
        return "no parcel of '" + options.split_by +
               "' touches a building, so none was cut; give the parcels of the same place";
    const double usual = std::max(usual_m, usual_cells * std::sqrt(cell.area()));
    if (report.best_offset)
        return displaced_doubt(*report.best_offset, usual, options);
    if (report.near_wall_length_m < least_length_m ||
        report.near_wall_length_m < least_share * report.cut_length_m || !(report.median_distance_m > usual))
        return {};
    return "cuts by '" + options.split_by + "' run " + rounded(report.median_distance_m) +
           " m off walls (the median over " + rounded(report.near_wall_length_m) +
           " m of cuts), and half a metre is usual: the parcels may be displaced as a whole; compare them "
           "with the buildings, and move them if that is right";
}

std::string overlap_warning(const ParcelReport& report, const DetectOptions& options) {
    if (report.overlap_m2 <= usual_overlap * report.inside_m2)
        return {};
    return percent(report.overlap_m2 / report.inside_m2) + " of the building area in parcels of '" +
           options.split_by +
           "' lies in more than one parcel and goes to the one with the lowest id; leave out the parcels "
           "that do not apply";
}

std::string validity_warning(const ParcelReport& report, const DetectOptions& options) {
    if (report.invalid_m2 == 0)
        return {};
    return "parcels of '" + options.split_by + "' that are invalid hold " + rounded(report.invalid_m2) +
           " m2 of buildings, and the area that an odd number of their rings encloses is used; make them "
           "valid, for example by ogr2ogr -makevalid";
}

std::string unplaced_footprints_warning(const FootprintReport& report, const std::string& layer,
                                        const std::string& dem) {
    if (report.given == 0 || report.outside + report.without_cell + report.without_polygon < report.given)
        return {};
    const std::string none = "none of the footprints of '" + layer + "' gets heights, because ";
    if (report.without_polygon == report.given)
        return none +
               "they have no polygons; give a dataset of polygons, or another of its layers with "
               "-footprints_layer";
    if (report.outside > 0)
        return none + "their polygons lie outside of '" + dem +
               "' or the used part of it; check the CRS of both, and -srcwin or -te";
    return none + "no centre of a cell of '" + dem + "' lies in their polygons; give a raster of finer cells";
}

std::string explain_empty_search(const SearchSummary& search) {
    for (const auto& reason : empty_search_reasons)
        if (std::string text = reason(search); !text.empty())
            return text;
    return "nothing that rises by more than " + number_text(search.plan.asked.detect.min_height) +
           " m above the ground is as smooth and wide as a roof; cells should be at most 1 m wide, or 2.5 m "
           "for large buildings, and -write_canopy shows everything that rises";
}

std::string explain_empty_result(const contours::LevelPlan& plan, std::size_t buildings, const DemInfo& dem,
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
    const bool plausible = surface_doubt(search).empty();
    for (const SearchWarning& warning : search_warnings)
        if (warning.when == When::always || (warning.when == When::found ? found_any : plausible))
            warn_unless_empty(warning.text(search, report), context);
    if (!found_any && report.minimum != report.maximum)
        context.warn("No building was found: " + explain_empty_search(search) + ".");
}

}  // namespace d2b::diagnose
