#include "diagnose/odd_heights.hpp"

#include <cmath>
#include <string>

#include "core/value_counts.hpp"

namespace d2b {
namespace {

constexpr double highest_m = 1000;     // the highest building of the world has 828 m
constexpr double negligible_m = 1e-6;  // rounding error of a mean

std::string whole_metres(double metres) {
    return value_text(std::round(metres)) + " m";
}

std::string advice(double elevation) {
    return " has an elevation of " + value_text(elevation) +
           "; give the value that stands for no data with -snodata, the range of elevations with -zrange, or "
           "their "
           "unit "
           "with -zunit.";
}

/// "Building 3 is", "12 buildings are"
std::string who(std::int64_t buildings, std::int64_t id, const char* one, const char* more) {
    return buildings == 1 ? "Building " + std::to_string(id) + one
                          : std::to_string(buildings) + " buildings" + more;
}

}  // namespace

void OddHeights::Odd::add(std::int64_t building, double metres, double extreme, bool farther) {
    if (buildings++ == 0 || farther) {
        id = building;
        height_m = metres;
        elevation = extreme;
    }
}

void OddHeights::note(const BuildingRecord& building, const ContourRecord& footprint) {
    if (building.height_m > highest_m)
        high_.add(building.id, building.height_m, building.roof, building.height_m > high_.height_m);
    if (building.mean_m < -negligible_m)
        low_.add(building.id, building.mean_m, footprint.lowest, building.mean_m < low_.height_m);
}

std::vector<std::string> OddHeights::warnings() const {
    std::vector<std::string> sentences;
    if (high_.buildings > 0)
        sentences.push_back(who(high_.buildings, high_.id, " is", " are") + " more than " +
                            whole_metres(highest_m) + " high: building " + std::to_string(high_.id) + ", " +
                            whole_metres(high_.height_m) + "," + advice(high_.elevation));
    if (low_.buildings > 0)
        sentences.push_back(who(low_.buildings, low_.id, " has", " have") +
                            " a negative volume, being lower than the ground on average: building " +
                            std::to_string(low_.id) + advice(low_.elevation));
    return sentences;
}

}  // namespace d2b
