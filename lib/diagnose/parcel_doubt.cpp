#include <algorithm>
#include <cmath>

#include "diagnose/parcel_fit.hpp"
#include "diagnose/words.hpp"

namespace d2b {
namespace {

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
           " m beside the walls as a whole: they fit best if they are moved " + told(move) +
           " on the raster; compare them with the buildings, and move them where that is so";
}

}  // namespace

std::string misplaced_doubt(const ParcelReport& report, const CellSize& cell, const DetectOptions& options) {
    if (report.inside_m2 == 0 && report.cut_length_m == 0)
        return "no parcel of '" + options.split_by +
               "' touches a building, so none was cut; give the parcels of the same place";
    const double usual = std::max(usual_m, usual_cells * std::sqrt(cell.area()));
    if (report.fitting_move)
        return displaced_doubt(*report.fitting_move, usual, options);
    if (report.beside_length_m < least_length_m ||
        report.beside_length_m < least_share * report.cut_length_m || !(report.median_distance_m > usual))
        return {};
    return "cuts by '" + options.split_by + "' run " + rounded(report.median_distance_m) +
           " m beside walls (the median of " + rounded(report.beside_length_m) +
           " m), where half a metre is usual: the parcels may be displaced as a whole; compare them with the "
           "buildings, and move them where that is so";
}

std::string overlap_doubt(const ParcelReport& report, const DetectOptions& options) {
    if (report.several_m2 <= usual_overlap * report.inside_m2)
        return {};
    return percent(report.several_m2 / report.inside_m2) + " of what parcels of '" + options.split_by +
           "' hold of buildings lies in more than one of them, and is taken for the one with the lowest id; "
           "leave out those that are not meant";
}

std::string validity_doubt(const ParcelReport& report, const DetectOptions& options) {
    if (report.invalid_m2 == 0)
        return {};
    return "parcels of '" + options.split_by + "' that are not valid hold " + rounded(report.invalid_m2) +
           " m2 of buildings, and are taken for what an odd number of their rings encloses; make them valid, "
           "for example by ogr2ogr -makevalid";
}

}  // namespace d2b
