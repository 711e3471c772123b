#include "diagnose/traced_doubt.hpp"

#include "diagnose/words.hpp"

namespace d2b {

namespace {

std::string sentence(double share, const std::string& whose, double cell_size_m) {
    constexpr double fine_cell_m = 1.25;
    const std::string what =
        percent(share) + " of the length of the " + whose + "' outlines keeps the staircase of the cells";
    if (cell_size_m > fine_cell_m)
        return what + ", since walls cannot be seen in cells of " + rounded(cell_size_m) +
               " m; use a finer raster, or a larger -regularize_tolerance";
    return what +
           ", since straight walls would have left the trace or met a neighbour; -write_rejected shows these "
           "outlines, and a larger -regularize_tolerance may straighten more";
}

}  // namespace

std::string traced_doubt(const OutlineLength& buildings, const OutlineLength& contours, double cell_size_m) {
    constexpr double most_of_buildings = 0.05;
    constexpr double most_of_contours = 0.9;
    if (buildings.traced_share() > most_of_buildings)
        return sentence(buildings.traced_share(), "buildings", cell_size_m);
    if (!(buildings.whole() > 0) && contours.traced_share() > most_of_contours)
        return sentence(contours.traced_share(), "contours", cell_size_m);
    return {};
}

}  // namespace d2b
