#include "diagnose/ground_doubt.hpp"

#include <cmath>

#include "core/number_text.hpp"
#include "diagnose/words.hpp"

namespace d2b {
namespace {

constexpr double fewest_bare = 0.05;
constexpr double farthest_m = 2;
constexpr double fewest_raised = 0.001;

std::string within(const GroundFit& fit) {
    return "only " + percent(fit.bare_share()) + " of the cells lie within " + number_text(fit.min_height()) +
           " m of ";
}

std::string doubt_of_given(const GroundFit& fit, const std::string& terrain, bool few) {
    const std::string see = "; check whether both have the same unit and vertical datum";
    if (few)
        return within(fit) + "the terrain '" + terrain + "', above which the surface lies " +
               rounded(fit.median()) + " m (median)" + see;
    const double median = fit.bare_median();
    return "the terrain '" + terrain + "' lies " + rounded(std::abs(median)) + " m " +
           (median < 0 ? "above" : "below") + " the surface where nothing stands on it (median)" + see;
}

}  // namespace

std::string ground_doubt(const GroundFit& fit, GroundMode mode, const std::string& terrain) {
    const bool few = fit.bare_share() < fewest_bare;
    if (fit.cells() == 0 || (!few && !(std::abs(fit.bare_median()) > farthest_m)))
        return {};
    if (mode == GroundMode::given)
        return doubt_of_given(fit, terrain, few);
    if (mode == GroundMode::none)
        return "-ground none takes elevations as heights above the ground, and their median is " +
               rounded(few ? fit.median() : fit.bare_median()) + " m" + (few ? "" : " where they are low") +
               "; give a terrain model with -ground, or leave -ground out to have the ground estimated";
    return within(fit) + "the ground that was estimated" +
           (few ? "" : ", and these " + rounded(fit.bare_median()) + " m above it (median)") +
           "; give a terrain model with -ground, or use a larger part of the raster";
}

std::string surface_doubt(const GroundFit& fit, const std::string& dem) {
    const double usual = DetectOptions{}.min_height;
    const double share = fit.share_above(usual);
    if (fit.cells() == 0 || share >= fewest_raised)
        return {};
    return (share > 0 ? percent(share) : "none") + " of the cells of '" + dem + "' rise by more than " +
           number_text(usual) +
           " m above their surroundings, as in a terrain model (DTM), which has no buildings; give the "
           "surface model (DSM)";
}

}  // namespace d2b
