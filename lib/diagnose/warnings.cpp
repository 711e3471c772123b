#include "diagnose/warnings.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "detect/smoothness.hpp"
#include "options/run_plan.hpp"

namespace d2b::diagnose {

std::string rounded(double value) {
    constexpr double whole_from = 10;
    return number_text(std::abs(value) < whole_from ? std::round(value * 10) / 10 : std::round(value));
}

std::string percent(double share) {
    constexpr double whole_from = 0.02;
    constexpr double least = 0.001;
    if (share > 0 && share < least)
        return "less than 0.1 %";
    return (share < whole_from ? rounded(share * 100) : number_text(std::round(share * 100))) + " %";
}

std::string as_sentence(std::string cause) {
    if (!cause.empty() && cause.front() >= 'a' && cause.front() <= 'z')
        cause.front() = static_cast<char>(cause.front() - 'a' + 'A');
    return cause + ".";
}

namespace {

constexpr double widest_degree_cell = 0.001;  // about 100 m
constexpr double narrowest_building_m = 3;

/// Formats a number with three digits.
std::string short_text(double value) {
    if (!(value > 0))
        return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return number_text(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value));
}

// Ann Arbor, which was resampled, has 1.9; the town of docs/accuracy.md as seen by a satellite has 4.4.
constexpr double widest_step = 2.5;

std::string sentence(double share, const std::string& whose, const std::string& state, double cell_size_m) {
    constexpr double fine_cell_m = 1.25;
    const std::string what = percent(share) + " of the length of the " + whose + "' outlines " + state;
    if (cell_size_m > fine_cell_m)
        return what + ", because walls cannot be seen in cells of " + rounded(cell_size_m) +
               " m; use a finer raster, or a larger -regularize_tolerance";
    return what +
           ", because straight walls would have left the trace or met a neighbour; -write_rejected shows "
           "these outlines, and a larger -regularize_tolerance may straighten more";
}

std::string millions(std::int64_t points) {
    return number_text(std::round(static_cast<double>(points) / 1e6)) + " million points";
}

std::string what_is_seen(const SeenPoints& seen) {
    constexpr double bytes_a_point = 20;  // surface, terrain, and scratch memory for computing them
    constexpr double gib = 1 << 30;
    return millions(seen.points) + " at a time, because each part of the raster has a margin of " +
           rounded(seen.around) + " m" +
           (seen.max_building_width
                ? " (five times -max_building_width " + number_text(*seen.max_building_width) + ")"
                : "") +
           ", which takes some " + rounded(static_cast<double>(seen.points) * bytes_a_point / gib) +
           " GiB of memory";
}

}  // namespace

std::string picture_warning(const DemInfo& dem) {
    constexpr int colours = 3;
    if (dem.bands < colours && !dem.bytes)
        return {};
    const std::string what =
        dem.bands < colours ? "byte values"
                            : std::to_string(dem.bands) + " bands" + (dem.bytes ? " of byte values" : "");
    return "'" + dem.name + "' has " + what +
           ", like a picture or a hillshade; give a surface model (DSM), or choose the band of its "
           "elevations "
           "with -b";
}

std::string degrees_warning(const DemInfo& dem, bool has_crs) {
    const AffineTransform& g = dem.transform;
    const double cell = std::max(std::hypot(g[1], g[4]), std::hypot(g[2], g[5]));
    if (has_crs || !dem.georeferenced || cell > widest_degree_cell)
        return {};
    for (const std::int32_t row : {0, dem.rows})
        for (const std::int32_t col : {0, dem.cols})
            if (std::abs(g[0] + col * g[1] + row * g[2]) > 180 ||
                std::abs(g[3] + col * g[4] + row * g[5]) > 90)
                return {};
    return "'" + dem.name +
           "' has no CRS, and its coordinates look like degrees, but were taken as metres; give -a_srs "
           "EPSG:4326 if they are degrees, else their CRS";
}

std::string extent_warning(const std::string& dem, double width, double height) {
    if (std::min(width, height) >= narrowest_building_m && width * height >= default_min_building_m2)
        return {};
    return "'" + dem + "' covers " + short_text(width) + " m x " + short_text(height) +
           " m, which is less than a building; give the right CRS with -a_srs, or a larger part of the "
           "raster";
}

std::string sparse_points_warning(const SamplingReport& report, double side) {
    if (!detect::has_sparse_points(report.interpolated_fraction) || !report.points_per_cell)
        return {};
    return "points are sparse: about " + rounded(*report.points_per_cell) + " per cell of " + rounded(side) +
           " m, and none in " + percent(report.interpolated_fraction) +
           " of the cells, so roofs look rough, small houses may be missed, and crowns taken for houses; use "
           "a denser scan, or check the objects that -write_doubtful writes";
}

bool is_blurred(const SamplingReport& report) {
    return report.edge_width_cells && *report.edge_width_cells > widest_step;
}

std::string blur_warning(const SamplingReport& report, double side) {
    if (!is_blurred(report))
        return {};
    const std::string metres = rounded(*report.edge_width_cells * side) + " m";
    return "walls are blurred: they extend over " + rounded(*report.edge_width_cells) + " cells (" + metres +
           "), as in surfaces from satellites or with cells finer than their data, so narrower gaps and "
           "courtyards are closed, and corners and small houses are lost; use a surface whose walls extend "
           "over at most two cells";
}

std::string rounding_warning(const SamplingReport& report, double metres) {
    constexpr double least_m = 0.5;
    constexpr double rounding = 1e-6;
    const double step = report.value_step.value_or(0) * metres;
    if (step < least_m - rounding)
        return {};
    return "elevations are rounded to steps of " + number_text(std::round(step * 100) / 100) +
           " m, so a roof may be as rough as a crown, and low buildings, small parts and heights are "
           "uncertain by "
           "as much; use elevations that are rounded to centimetres, or not at all";
}

std::string coarse_cells_warning(double cell_m) {
    constexpr double coarsest_cell_m = 3.0;
    if (!(cell_m > coarsest_cell_m))
        return {};
    return "the cells are " + fixed_text(cell_m, 1) +
           " m wide, which is too coarse for single buildings; up to 1 m is best, 2.5 m may do";
}

std::string surface_scale_warning(const std::string& crs, double area_scale) {
    constexpr double most = 0.01;
    if (!(std::abs(area_scale - 1) > most))
        return {};
    return "-surface: '" + crs + "' shows areas here " + fixed_text(area_scale, 2) +
           " times as large as on the ground, and heights stay as they are, so blocks have other proportions "
           "and volumes than the buildings; give a CRS of the area with -t_srs, such as its UTM zone";
}

std::string tolerance_warning(double tolerance, double cell) {
    constexpr double most_cells = 100;
    const double cells = tolerance / cell;
    if (!(cells > most_cells))
        return {};
    return "-simplify " + number_text(tolerance) + " is " + number_text(std::round(cells)) +
           " cells wide, which leaves little of a building; it is in units of the input's CRS";
}

std::string traced_warning(const OutlineLength& buildings, const OutlineLength& contours, bool walls,
                           double cell_size_m) {
    const std::string traced = "keeps the staircase of the cells";
    constexpr double most_of_buildings = 0.05;
    constexpr double most_of_contours = 0.9;
    if (buildings.traced_share() > most_of_buildings)
        return sentence(buildings.traced_share(), "buildings", traced, cell_size_m);
    if (walls && buildings.share_without_walls() > most_of_buildings)
        return sentence(buildings.share_without_walls(), "buildings", "has no straight walls", cell_size_m);
    if (!(buildings.whole() > 0) && contours.traced_share() > most_of_contours)
        return sentence(contours.traced_share(), "contours", traced, cell_size_m);
    return {};
}

std::string doubtful_roofs_warning(const RoofReport& roofs) {
    constexpr double most = 0.5;
    if (roofs.level)
        return "all faces of roofs are level and doubtful, because blurred walls mean blurred ridges, which "
               "have "
               "no slopes to trust; use a sharper surface, or leave -roofs out";
    if (!(roofs.doubtful_area_m2 > most * roofs.area_m2))
        return {};
    return percent(roofs.doubtful_area_m2 / roofs.area_m2) +
           " of the area of roofs is doubtful, because faces are too narrow for the cells or no plane suits "
           "their points; use a finer raster, or leave -roofs out";
}

std::string unit_memory_notice(const SeenPoints& seen) {
    if (seen.points <= SeenPoints::usual)
        return {};
    return "ground and buildings are searched in up to " + what_is_seen(seen);
}

std::string unit_memory_refusal(const SeenPoints& seen) {
    if (seen.points <= SeenPoints::most)
        return {};
    return "Ground and buildings would be searched in " + what_is_seen(seen) + "; more than " +
           millions(SeenPoints::most) + " exceed the limit, so " +
           (seen.max_building_width ? "give a smaller -max_building_width."
                                    : "make the cells larger with gdalwarp -tr.");
}

}  // namespace d2b::diagnose
