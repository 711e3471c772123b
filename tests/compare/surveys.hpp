#pragma once

#include <vector>

#include "compare/surveyed_building.hpp"

namespace d2b::test {

inline WorldRing ring_of_box(double left, double low, double right, double high) {
    return {{left, low}, {right, low}, {right, high}, {left, high}};
}

/// A building with a rectangular outline of which only p90 is known, in a plane of metres.
inline compare::SurveyedBuilding box_building(double left, double low, double right, double high, double p90,
                                              double confidence = 0.9) {
    compare::SurveyedBuilding building;
    building.outline = {{ring_of_box(left, low, right, high), {}}};
    building.written = building.outline;
    building.area_m2 = (right - left) * (high - low);
    building.heights.percentiles[p90_share] = p90;
    building.confidence = confidence;
    return building;
}

/// Numbers buildings from 1.
inline compare::SurveyedPlace place_of(std::vector<compare::SurveyedBuilding> buildings) {
    compare::SurveyedPlace place;
    for (compare::SurveyedBuilding& building : buildings) {
        building.id = static_cast<std::int64_t>(place.buildings.size()) + 1;
        place.buildings.push_back(std::move(building));
    }
    return place;
}

}  // namespace d2b::test
